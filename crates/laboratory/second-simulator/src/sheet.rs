//! What a reader sees of a mechanism.

/// Description of a mechanism and its parameters.
#[derive(Debug, PartialEq)]
pub struct Sheet {
    /// Name, kebab-case; that of the effect where the catalogue has the same physics.
    pub id: &'static str,
    /// Whether the catalogue of effects knows this physics.
    pub origin: Origin,
    /// The law of this crate.
    pub law: &'static str,
    /// How its size compares with that of the catalogue's law, or where it stems from.
    pub size: &'static str,
    /// Invariances of the ICR triple that it breaks.
    pub breaks: &'static [Invariance],
    /// Parameters, in the order in which the law takes them.
    pub parameters: &'static [Parameter],
}

impl Sheet {
    /// The keys of the parameters, separated by commas.
    pub fn keys(&self) -> String {
        self.parameters.iter().map(|parameter| parameter.key).collect::<Vec<_>>().join(", ")
    }
}

/// Whether a diagnosis can name a mechanism.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Origin {
    /// The catalogue of effects has this physics under the same id.
    Catalogue,
    /// No catalogue has it: the right answer is that something unknown is there, and where.
    Outside,
}

/// A parameter of a mechanism.
#[derive(Debug, PartialEq)]
pub struct Parameter {
    /// Name; ends in the unit where there is one.
    pub key: &'static str,
    /// Unit, `1` for pure numbers.
    pub unit: &'static str,
    /// Smallest and largest value that is physical.
    pub range: [f64; 2],
    /// A size that a roboticist may meet.
    pub typical: f64,
}

/// An invariance that the ICR triple (x_l, x_r, y) has where nothing is missing.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Invariance {
    /// S: all speeds scaled by one factor.
    SpeedScale,
    /// R: all speeds reversed.
    Reversal,
    /// P: same-sign arc, counter-rotation, spin.
    Manoeuvre,
    /// M: left and right exchanged.
    Mirror,
    /// H: turned to another heading.
    Heading,
    /// X: moved to another place.
    Place,
    /// T: driven at another time.
    Time,
    /// D: speeds that change.
    Transient,
    /// 0: equal speeds lead straight ahead.
    Straight,
}

impl Invariance {
    /// All of them, in the order of tables.
    pub const ALL: [Self; 9] = [
        Self::SpeedScale,
        Self::Reversal,
        Self::Manoeuvre,
        Self::Mirror,
        Self::Heading,
        Self::Place,
        Self::Time,
        Self::Transient,
        Self::Straight,
    ];

    /// The letter that tables use.
    pub fn letter(self) -> char {
        match self {
            Self::SpeedScale => 'S',
            Self::Reversal => 'R',
            Self::Manoeuvre => 'P',
            Self::Mirror => 'M',
            Self::Heading => 'H',
            Self::Place => 'X',
            Self::Time => 'T',
            Self::Transient => 'D',
            Self::Straight => '0',
        }
    }
}
