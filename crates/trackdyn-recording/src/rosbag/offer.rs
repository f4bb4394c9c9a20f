//! Which numbers of a log without joints may tell its track speeds, and the options that read them.

use super::definition::Texts;
use super::names;
use super::topic::Topic;
use super::twist;
use super::words::{LEFT, RIGHT, words};
use trackdyn_core::Side;

/// Packages whose messages have no speed of a track.
const OTHER_PACKAGES: [&str; 9] = [
    "sensor_msgs",
    "geometry_msgs",
    "nav_msgs",
    "tf2_msgs",
    "tf",
    "rcl_interfaces",
    "rosgraph_msgs",
    "visualization_msgs",
    "diagnostic_msgs",
];

/// Most topics, and most fields of one, that an offer lists.
const MAX_OFFERED_TOPICS: usize = 6;
const MAX_FIELDS: usize = 16;

/// Words of numbers that are speeds, and of numbers that count on.
const SPEEDS: [&str; 8] =
    ["velocity", "vel", "vels", "velocities", "speed", "speeds", "rpm", "rps"];
const COUNTS: [&str; 13] = [
    "tick",
    "ticks",
    "count",
    "counts",
    "counter",
    "encoder",
    "encoders",
    "position",
    "positions",
    "pos",
    "angle",
    "pulse",
    "pulses",
];

/// What a number is by the words of its topic and field, the likelier track speed first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum What {
    Speed,
    Unknown,
    Count,
}

/// What a log without joints has whose numbers may be speeds of the tracks, and the options that
/// read them.
pub(super) fn offer(texts: &Texts, seen: &[Topic]) -> Option<String> {
    let may_have = |topic: &&Topic| {
        let package = topic.kind.split('/').next().unwrap_or_default();
        topic.layout().is_none()
            && !OTHER_PACKAGES.contains(&package)
            && !twist::is_command(&topic.name)
    };
    let topics: Vec<&Topic> = seen.iter().filter(may_have).collect();
    let fields = |topic: &Topic| -> Vec<String> {
        let definition = texts.definition(&topic.kind);
        definition.map(|definition| definition.numbers()).unwrap_or_default()
    };
    let fields: Vec<(&str, Vec<String>)> =
        topics.iter().map(|topic| (topic.name.as_str(), fields(topic))).collect();
    pair(&fields).or_else(|| listed(&fields))
}

/// An offer of two numbers whose names differ in their side; none where there are none.
fn pair(fields: &[(&str, Vec<String>)]) -> Option<String> {
    let named = |(topic, fields): &(&str, Vec<String>)| -> Vec<String> {
        fields.iter().map(|field| format!("{topic}:{field}")).collect()
    };
    let numbers: Vec<String> = fields.iter().flat_map(named).collect();
    let of_left = numbers.iter().filter(|name| names::side(name) == Some(Side::Left));
    let pairs = of_left.filter_map(|left| {
        let mirrored = mirrored(left);
        Some([left, numbers.iter().find(|right| words(right) == mirrored)?])
    });
    let [left, right] = pairs.min_by_key(|[left, _]| what(left))?;
    let options = format!("--left-signal {left} --right-signal {right}");
    Some(match what(left) {
        What::Count => format!(
            "numbers of other messages are read, where they are counts or angles of encoders, by \
             {options} --joint-signal position, with --wheel-radius in m per unit of them"
        ),
        What::Speed => format!(
            "numbers of other messages are read, where they are measured speeds of the sides, by \
             {options}"
        ),
        What::Unknown => format!(
            "numbers of other messages are read, where they are measured speeds of the sides, by \
             {options}, and where they are counts of encoders, with --joint-signal position"
        ),
    })
}

/// The words of a name with its sides changed from left to right.
fn mirrored(left: &str) -> Vec<String> {
    let mirrored = |word: String| match word.as_str() {
        "left" => "right".to_owned(),
        "l" => "r".to_owned(),
        "lhs" => "rhs".to_owned(),
        other => {
            let place = LEFT.iter().position(|left| *left == other);
            place.map_or(word, |place| RIGHT[place].to_owned())
        }
    };
    words(left).into_iter().map(mirrored).collect()
}

fn what(name: &str) -> What {
    let words = words(name);
    let has = |list: &[&str]| words.iter().any(|word| list.contains(&word.as_str()));
    if has(&SPEEDS) {
        What::Speed
    } else if has(&COUNTS) {
        What::Count
    } else {
        What::Unknown
    }
}

/// An offer of all numbers; none where no topic may have any.
fn listed(fields: &[(&str, Vec<String>)]) -> Option<String> {
    let (first, _) = fields.first()?;
    let more = if fields.len() > MAX_OFFERED_TOPICS { " and others" } else { "" };
    let fields = &fields[..fields.len().min(MAX_OFFERED_TOPICS)];
    let names: Vec<&str> = fields.iter().map(|(topic, _)| *topic).collect();
    let known = fields.iter().filter(|(_, fields)| !fields.is_empty());
    let known: Vec<String> = known
        .map(|(topic, fields)| {
            let more = if fields.len() > MAX_FIELDS { " and others" } else { "" };
            format!("; {topic} has {}{more}", fields[..fields.len().min(MAX_FIELDS)].join(", "))
        })
        .collect();
    let of_arrays = if known.iter().any(|fields| fields.contains("[0]")) {
        " ([0] is the first of an array)"
    } else {
        ""
    };
    Some(format!(
        "numbers of other messages ({}{more}) are read, where they are measured speeds of the \
         sides, by --left-signal {first}:FIELD --right-signal {first}:FIELD{}{of_arrays}",
        names.join(", "),
        known.concat()
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn offered(topics: &[(&str, &str, &str)]) -> String {
        let mut texts = Texts::default();
        let topic = |(name, kind, text): &(&str, &str, &str)| {
            texts.add(kind, text);
            Topic { name: (*name).to_owned(), kind: (*kind).to_owned(), encoding: "cdr".to_owned() }
        };
        let seen: Vec<Topic> = topics.iter().map(topic).collect();
        offer(&texts, &seen).expect("an offer")
    }

    #[test]
    fn numbers_of_left_and_right_are_paired_by_their_words() {
        let number = "std_msgs/msg/Float64";
        let text = offered(&[("/r_wheel/vel", number, ""), ("/l_wheel/vel", number, "")]);
        let options = "--left-signal /l_wheel/vel:data --right-signal /r_wheel/vel:data";
        assert!(text.contains(options), "{text}");
        let ticks = ("/ticks", "my/msg/Ticks", "int32 ticks_left\nint32 ticks_right");
        let text = offered(&[ticks, ("/w", "my/msg/Vels", "float32 left_rpm\nfloat32 right_rpm")]);
        assert!(text.contains("--left-signal /w:left_rpm --right-signal /w:right_rpm"), "{text}");
        let text = offered(&[ticks]);
        let options = "--right-signal /ticks:ticks_right --joint-signal position";
        assert!(text.contains(options), "{text}");
    }

    #[test]
    fn numbers_without_a_side_are_listed() {
        let rule = "=".repeat(80);
        let kind = "my/msg/Status";
        let definition = format!(
            "std_msgs/Header header\nfloat32 volts\nstring mode\nActuator[] motors\n\
             float32[4] speed\n{rule}\nMSG: my/Actuator\nuint8 id\nint16 rpm"
        );
        let text = offered(&[("/status", kind, &definition), ("/other", "my/msg/Unknown", "")]);
        for part in [
            "(/status, /other)",
            "--left-signal /status:FIELD --right-signal /status:FIELD",
            "; /status has volts, motors[0].id, motors[0].rpm, speed[0]",
        ] {
            assert!(text.contains(part), "{part} is not in {text}");
        }
    }
}
