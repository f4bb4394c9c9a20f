//! Times that are written as dates or as the time of day.

/// Seconds of a day.
const DAY: f64 = 86_400.0;

/// Reads times in the order of a table: the time of day goes on over midnight.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Times {
    last: f64,
    /// Time of the midnights so far, s.
    midnights: f64,
}

impl Times {
    /// Seconds of a time, of Unix or of the first day: `2024-03-31T00:59:30.050+02:00`,
    /// `2024-03-31 00:59:30`, `31.03.2024 00:59:30` or `00:59:30.050`. None of others: a date
    /// between slashes may be of the day or of the month first.
    pub(super) fn read(&mut self, text: &[u8]) -> Option<f64> {
        let text = std::str::from_utf8(text).ok()?;
        if let Some((date, time)) = text.split_once(['T', ' ']) {
            let (time, zone) = zone(time.trim())?;
            return Some(DAY * days(date)? + clock(time)? - zone);
        }
        let time = clock(text)?;
        // A robot drives for less than half a day between two readings.
        if time < self.last - 0.5 * DAY {
            self.midnights += DAY;
        }
        self.last = time;
        Some(self.midnights + time)
    }
}

/// Seconds since midnight of `hh:mm:ss`, with or without a fraction.
fn clock(text: &str) -> Option<f64> {
    let mut parts = text.split(':');
    let (hours, minutes, seconds) = (parts.next()?, parts.next()?, parts.next()?);
    let (hours, minutes): (u8, u8) = (hours.parse().ok()?, minutes.parse().ok()?);
    let is_plain = seconds.bytes().all(|byte| byte.is_ascii_digit() || b".,".contains(&byte));
    let seconds: f64 = seconds.replace(',', ".").parse().ok().filter(|_| is_plain)?;
    let is_time = parts.next().is_none() && hours < 24 && minutes < 60 && seconds < 61.0;
    is_time.then(|| 3600.0 * f64::from(hours) + 60.0 * f64::from(minutes) + seconds)
}

/// A time without its zone, and how much later than Greenwich that is, s.
fn zone(text: &str) -> Option<(&str, f64)> {
    if let Some(time) = text.strip_suffix(['Z', 'z']) {
        return Some((time, 0.0));
    }
    let Some(at) = text.rfind(['+', '-']) else { return Some((text, 0.0)) };
    let (time, zone) = text.split_at(at);
    let digits = zone.get(1..)?.replace(':', "");
    let hours: u8 = digits.get(..2)?.parse().ok()?;
    let minutes: u8 =
        digits.get(2..).filter(|text| !text.is_empty()).map_or(Ok(0), str::parse).ok()?;
    let offset = 3600.0 * f64::from(hours) + 60.0 * f64::from(minutes);
    Some((time, if zone.starts_with('-') { -offset } else { offset }))
}

/// Days from 1970-01-01 to a date of the Gregorian calendar, year first or with points.
fn days(date: &str) -> Option<f64> {
    let parts = |separator: char| -> Option<[i32; 3]> {
        let parts: Result<Vec<i32>, _> = date.split(separator).map(str::parse).collect();
        parts.ok()?.try_into().ok()
    };
    let with_points = || parts('.').map(|[day, month, year]| [year, month, day]);
    let [year, month, day] = parts('-').or_else(|| parts('/')).or_else(with_points)?;
    if !(1900..3000).contains(&year) || !(1..=12).contains(&month) || !(1..=31).contains(&day) {
        return None;
    }
    // Years begin in March, so that the leap day is the last of them.
    let (year, month) = if month > 2 { (year, month - 3) } else { (year - 1, month + 9) };
    let of_years = 365 * year + year / 4 - year / 100 + year / 400;
    let of_months = (153 * month + 2) / 5;
    // 719468 days lead from the first of March of the year 0 to 1970.
    Some(f64::from(of_years + of_months + day - 1 - 719_468))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dates_and_times_of_day_are_seconds() {
        let read = |text: &str| Times::default().read(text.as_bytes());
        assert_eq!(read("1970-01-01T00:00:00Z"), Some(0.0));
        assert_eq!(read("2024-03-31T00:59:30.5+02:00"), Some(1_711_839_570.5));
        assert_eq!(read("2024-03-31 00:59:30.5"), Some(1_711_846_770.5));
        assert_eq!(read("31.03.2024 00:59:30.5"), Some(1_711_846_770.5));
        assert_eq!(read("2000-02-29 00:00:00"), Some(951_782_400.0));
        for text in
            ["31/03/2024 00:00:00", "2024-13-01 00:00:00", "25:00:00", "12:30", "now", "1.5"]
        {
            assert_eq!(read(text), None, "{text}");
        }
        let mut times = Times::default();
        let read: Vec<_> =
            ["23:59:59,5", "00:00:00.5"].map(|text| times.read(text.as_bytes())).into();
        assert_eq!(read, [Some(86_399.5), Some(86_400.5)]);
    }
}
