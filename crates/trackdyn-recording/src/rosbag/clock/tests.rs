//! Which clock dates the messages of a bag.

use super::*;

const SECOND: i64 = 1_000_000_000;

/// A message every 0.1 s, stamped by a clock.
fn clock(topic: &str, count: i64, stamp: impl Fn(i64) -> i64) -> (Clock, Vec<Received<f64>>) {
    let all = (0..count).map(|k| Received {
        stamp_ns: Some(stamp(k * SECOND / 10)).filter(|stamp| *stamp != 0),
        log_ns: 1_700_000_000 * SECOND + k * SECOND / 10,
        value: 0.0,
    });
    let all: Vec<_> = all.collect();
    (Clock::of(topic, &all), all)
}

const UNIX: i64 = 1_700_000_000 * SECOND;

#[test]
fn clocks_of_another_epoch_or_ahead_of_the_log_give_way_to_it() {
    let tracks = clock("tracks", 600, |t| UNIX + t - SECOND / 100).0;
    for (what, ahead, by) in [
        ("slam, 0.3 s late", -3 * SECOND / 10, By::Header),
        ("ahead", 3 * SECOND / 2, By::Log),
        ("leap seconds", 37 * SECOND, By::Log),
        ("leap seconds", -37 * SECOND, By::Log),
        ("since boot", 500 * SECOND - UNIX, By::Log),
        ("equal", 0, By::Header),
    ] {
        let poses = clock("poses", 600, |t| UNIX + t + ahead).0;
        let clocks = [tracks.clone(), poses];
        let (found, warnings) = decide(&clocks, Dating::Any);
        assert_eq!(found, by, "{what}");
        let is_told = ahead.abs() > SECOND / 5;
        assert_eq!(warnings.len(), usize::from(is_told), "{what}: {warnings:?}");
        assert_eq!(decide(&clocks, Dating::Header).0, By::Header);
    }
}

#[test]
fn a_driver_that_logs_in_bursts_keeps_its_stamps() {
    let (_, mut all) = clock("tracks", 600, |t| UNIX + t);
    for one in &mut all {
        one.log_ns = UNIX + ((one.log_ns - UNIX) / (5 * SECOND) + 1) * 5 * SECOND;
    }
    let tracks = Clock::of("tracks", &all);
    let poses = clock("poses", 600, |t| UNIX + t - SECOND / 100).0;
    let (by, warnings) = decide(&[tracks, poses], Dating::Any);
    assert_eq!((by, warnings.len()), (By::Header, 1), "{warnings:?}");
}

#[test]
fn a_clock_that_is_set_by_seconds_is_no_burst() {
    let tracks = clock("tracks", 600, |t| UNIX + t).0;
    let poses = clock("poses", 600, |t| UNIX + t - if t > 25 * SECOND { 4 * SECOND } else { 0 }).0;
    assert_eq!(decide(&[tracks, poses], Dating::Any).0, By::Log);
}

#[test]
fn stamps_of_whole_seconds_give_way_to_the_log_and_repeats_do_not() {
    let coarse = |topic: &str, changes: bool| {
        let readings = (0..600).map(|k: i32| Received {
            stamp_ns: Some(UNIX + i64::from(k / 10) * SECOND),
            log_ns: UNIX + i64::from(k) * SECOND / 10,
            value: f64::from(if changes { k } else { k / 10 }),
        });
        Clock::of(topic, &readings.collect::<Vec<_>>())
    };
    let poses = clock("poses", 600, |t| UNIX + t).0;
    let (by, warnings) = decide(&[coarse("tracks", true), poses.clone()], Dating::Any);
    assert_eq!((by, warnings.len()), (By::Log, 1), "{warnings:?}");
    assert_eq!(decide(&[coarse("tracks", false), poses], Dating::Any).0, By::Header);
}

#[test]
fn a_simulation_dates_what_it_does_not_stamp() {
    // The simulation takes three times as long as it simulates.
    let (_, mut all) = clock("tracks", 600, |t| t + SECOND);
    for one in &mut all {
        one.log_ns = UNIX + 3 * (one.log_ns - UNIX);
    }
    let tracks = Clock::of("tracks", &all);
    for stamp in [|_| 0, |t| UNIX + 3 * t] {
        let (_, mut poses) = clock("poses", 600, stamp);
        for one in &mut poses {
            one.log_ns = UNIX + 3 * (one.log_ns - UNIX);
        }
        let mut clocks = [tracks.clone(), Clock::of("poses", &poses)];
        share_rate(&mut clocks);
        assert_eq!(decide(&clocks, Dating::Any), (By::Header, Vec::new()));
        assert_eq!(clocks[1].date(By::Header, &poses[300]), Some(31 * SECOND));
        assert!(matches!(clocks[1].warnings(By::Header)[..], [Warning::ShownTime { .. }]));
    }
}

#[test]
fn a_bag_that_was_logged_at_another_time_keeps_its_stamps() {
    let tracks = clock("tracks", 600, |t| UNIX + t).0;
    let (_, mut all) = clock("poses", 600, |t| UNIX + t);
    for one in &mut all {
        one.log_ns += 86_400 * SECOND;
    }
    let poses = Clock::of("poses", &all);
    assert_eq!(decide(&[tracks, poses], Dating::Any).0, By::Header);
}

#[test]
fn stamps_before_the_clock_was_set_are_dropped_and_said() {
    let (clock, all) = clock("tracks", 600, |t| if t < SECOND / 2 { t } else { UNIX + t });
    let right = all.iter().filter(|one| clock.date(By::Header, one).is_some()).count();
    assert_eq!(right, 595);
    // one of the five is no stamp at all
    let told: Vec<u64> = clock
        .warnings(By::Header)
        .iter()
        .map(|warning| match warning {
            Warning::MessagesSkipped { count, .. } => *count,
            other => panic!("{other}"),
        })
        .collect();
    assert_eq!(told, [1, 4]);
    assert_eq!(decide(&[clock], Dating::Any).0, By::Header);
}

#[test]
fn a_clock_that_is_set_in_the_middle_gives_way_to_the_log() {
    let (clock, all) =
        clock("tracks", 600, |t| if t < 20 * SECOND { t + SECOND } else { UNIX + t });
    assert_eq!(decide(std::slice::from_ref(&clock), Dating::Any).0, By::Log);
    assert!(all.iter().all(|one| clock.date(By::Log, one) == Some(one.log_ns)));
}

#[test]
fn a_reset_begins_another_run_and_a_late_message_does_not() {
    let (reset, all) =
        clock("tracks", 600, |t| if t < 30 * SECOND { t + SECOND } else { t - 29 * SECOND });
    assert_eq!(reset.resets(), [UNIX + 30 * SECOND]);
    assert_eq!(segment(reset.resets(), all[299].log_ns), 0);
    assert_eq!(segment(reset.resets(), all[300].log_ns), 1);
    let late = clock("tracks", 600, |t| if t == 30 * SECOND { SECOND } else { t + SECOND }).0;
    assert_eq!(late.resets(), [0_i64; 0]);
}
