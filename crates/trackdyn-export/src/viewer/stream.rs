//! Messages of many topics in the order of time.

use std::borrow::Cow;
use std::io;

/// Turns the stamp and the place of a message in its stream into bytes.
pub(super) type Encode<'a> = Box<dyn Fn(u64, usize) -> io::Result<Vec<u8>> + 'a>;

/// The messages of one channel, in the order of time; each is made when its time comes.
pub(super) struct Stream<'a> {
    /// Its channel.
    pub(super) channel: u16,
    stamps: Cow<'a, [u64]>,
    encode: Encode<'a>,
    next: usize,
}

impl<'a> Stream<'a> {
    pub(super) fn new(
        channel: u16,
        stamps: impl Into<Cow<'a, [u64]>>,
        encode: impl Fn(u64, usize) -> io::Result<Vec<u8>> + 'a,
    ) -> Self {
        Self { channel, stamps: stamps.into(), encode: Box::new(encode), next: 0 }
    }

    fn stamp(&self) -> Option<u64> {
        self.stamps.get(self.next).copied()
    }
}

/// Shows all messages, by their stamps; at one stamp in the order of the streams.
pub(super) fn merge(
    mut streams: Vec<Stream<'_>>,
    mut show: impl FnMut(u16, u64, &[u8]) -> io::Result<()>,
) -> io::Result<()> {
    let earliest = |streams: &[Stream]| {
        let stamps = streams.iter().enumerate();
        stamps.filter_map(|(index, stream)| Some((stream.stamp()?, index))).min()
    };
    while let Some((stamp, index)) = earliest(&streams) {
        let stream = &mut streams[index];
        let bytes = (stream.encode)(stamp, stream.next)?;
        stream.next += 1;
        show(stream.channel, stamp, &bytes)?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn messages_come_in_the_order_of_time() {
        let encode = |stamp: u64, place: usize| Ok(format!("{stamp}.{place}").into_bytes());
        let streams = vec![
            Stream::new(0, vec![2, 5, 5], encode),
            Stream::new(1, vec![1, 5], encode),
            Stream::new(0, vec![], encode),
        ];
        let mut seen = Vec::new();
        merge(streams, |channel, stamp, bytes| {
            seen.push((channel, stamp, String::from_utf8_lossy(bytes).into_owned()));
            Ok(())
        })
        .expect("nothing fails");
        let expected = [(1, 1, "1.0"), (0, 2, "2.0"), (0, 5, "5.1"), (0, 5, "5.2"), (1, 5, "5.1")];
        assert_eq!(seen, expected.map(|(channel, stamp, text)| (channel, stamp, text.to_owned())));
    }
}
