//! Parts of the cases, for several machines.

use std::str::FromStr;

/// Every `of`-th case, from the `index`-th on, which is 1 to `of`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shard {
    index: usize,
    of: usize,
}

/// A text that is no shard.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("expected I/N with I from 1 to N, such as 2/4")]
pub struct NoShard;

impl Shard {
    /// What belongs to it of what all shards share.
    pub fn take<T>(self, all: Vec<T>) -> Vec<T> {
        all.into_iter().skip(self.index - 1).step_by(self.of).collect()
    }
}

impl Default for Shard {
    /// All cases.
    fn default() -> Self {
        Self { index: 1, of: 1 }
    }
}

/// Reads `I/N`.
impl FromStr for Shard {
    type Err = NoShard;

    fn from_str(text: &str) -> Result<Self, NoShard> {
        let parts = text.split_once('/').and_then(|(index, of)| {
            Some(Self { index: index.parse().ok()?, of: of.parse().ok()? })
        });
        parts.filter(|shard| (1..=shard.of).contains(&shard.index)).ok_or(NoShard)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shards_share_the_cases() {
        let of = |text: &str| text.parse::<Shard>().map(|shard| shard.take((1..=7).collect()));
        assert_eq!(of("1/3"), Ok(vec![1, 4, 7]));
        assert_eq!(of("3/3"), Ok(vec![3, 6]));
        assert_eq!(Shard::default().take(vec![1, 2]), [1, 2]);
        for text in ["", "2", "0/3", "4/3", "1/0", "a/b"] {
            assert_eq!(of(text), Err(NoShard), "{text}");
        }
    }
}
