//! The two sides of the machine.

/// Left or right running gear.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Side {
    /// Left of the direction of travel (negative x in the paper's frame).
    Left,
    /// Right of the direction of travel (positive x in the paper's frame).
    Right,
}

impl Side {
    /// Left, then right.
    pub const BOTH: [Self; 2] = [Self::Left, Self::Right];

    /// Its name in messages.
    pub fn name(self) -> &'static str {
        match self {
            Self::Left => "left",
            Self::Right => "right",
        }
    }

    /// The other side.
    #[inline]
    pub fn other(self) -> Self {
        match self {
            Self::Left => Self::Right,
            Self::Right => Self::Left,
        }
    }

    /// −1 for left, +1 for right: the sign of the side's x in the paper's frame.
    #[inline]
    pub fn sign(self) -> f64 {
        match self {
            Self::Left => -1.0,
            Self::Right => 1.0,
        }
    }
}

/// One value for each side.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PerSide<T> {
    /// Value of the left side.
    pub left: T,
    /// Value of the right side.
    pub right: T,
}

impl<T> PerSide<T> {
    /// Both values.
    #[inline]
    pub const fn new(left: T, right: T) -> Self {
        Self { left, right }
    }

    /// The value that `of` gives for each side.
    #[inline]
    pub fn from_fn(mut of: impl FnMut(Side) -> T) -> Self {
        Self { left: of(Side::Left), right: of(Side::Right) }
    }

    /// The values mapped by `f`.
    #[inline]
    pub fn map<U>(self, mut f: impl FnMut(T) -> U) -> PerSide<U> {
        PerSide { left: f(self.left), right: f(self.right) }
    }
}

impl<T> PerSide<Option<T>> {
    /// The value there is with its side; where both sides have one, what `both` makes of them, with
    /// no side. None where there is none.
    pub fn either(self, both: impl FnOnce(T, T) -> T) -> Option<(Option<Side>, T)> {
        match (self.left, self.right) {
            (Some(left), Some(right)) => Some((None, both(left, right))),
            (Some(left), None) => Some((Some(Side::Left), left)),
            (None, Some(right)) => Some((Some(Side::Right), right)),
            (None, None) => None,
        }
    }
}

impl<T> std::ops::Index<Side> for PerSide<T> {
    type Output = T;

    #[inline]
    fn index(&self, side: Side) -> &T {
        match side {
            Side::Left => &self.left,
            Side::Right => &self.right,
        }
    }
}

impl<T> std::ops::IndexMut<Side> for PerSide<T> {
    #[inline]
    fn index_mut(&mut self, side: Side) -> &mut T {
        match side {
            Side::Left => &mut self.left,
            Side::Right => &mut self.right,
        }
    }
}
