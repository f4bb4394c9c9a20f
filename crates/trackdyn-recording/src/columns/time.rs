//! Times that are written as dates or as the time of day.

use chrono::{DateTime, Datelike, NaiveDateTime, NaiveTime, Timelike};

/// Seconds of a day.
const DAY: f64 = 86_400.0;

/// Dates as tables have them, with points for commas in seconds.
const DATES: [&str; 3] = ["%Y-%m-%d %H:%M:%S%.f", "%Y/%m/%d %H:%M:%S%.f", "%d.%m.%Y %H:%M:%S%.f"];

/// Years that a robot may have been driven in; others are no dates.
const YEARS: std::ops::Range<i32> = 1900..3000;

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
        let text = std::str::from_utf8(text).ok()?.replace(',', ".");
        if let Some((date, time)) = text.split_once(['T', ' ']) {
            return unix(&format!("{date} {}", time.trim()));
        }
        let time = NaiveTime::parse_from_str(&text, "%H:%M:%S%.f").ok()?;
        let time =
            f64::from(time.num_seconds_from_midnight()) + 1e-9 * f64::from(time.nanosecond());
        // A robot drives for less than half a day between two readings.
        if time < self.last - 0.5 * DAY {
            self.midnights += DAY;
        }
        self.last = time;
        Some(self.midnights + time)
    }
}

/// Unix time of a date and time, s; without a zone, that of Greenwich.
fn unix(text: &str) -> Option<f64> {
    let text =
        text.strip_suffix(['Z', 'z']).map_or_else(|| text.to_owned(), |text| format!("{text}+00"));
    let parsed = DATES.iter().find_map(|form| {
        let in_zone = DateTime::parse_from_str(&text, &format!("{form}%#z"));
        let in_greenwich =
            |_| NaiveDateTime::parse_from_str(&text, form).map(|time| time.and_utc().into());
        in_zone.or_else(in_greenwich).ok()
    })?;
    #[expect(clippy::cast_precision_loss, reason = "seconds of the third millennium")]
    let seconds = parsed.timestamp() as f64;
    YEARS.contains(&parsed.year()).then(|| seconds + 1e-9 * f64::from(parsed.nanosecond()))
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
        // a day that no calendar has
        assert_eq!(read("2023-02-29 00:00:00"), None);
        let mut times = Times::default();
        let read: Vec<_> =
            ["23:59:59,5", "00:00:00.5"].map(|text| times.read(text.as_bytes())).into();
        assert_eq!(read, [Some(86_399.5), Some(86_400.5)]);
    }
}
