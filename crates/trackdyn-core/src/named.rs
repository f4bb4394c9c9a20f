//! Values that are chosen by their names.

/// The value of a name; else what was expected.
///
/// ```
/// use trackdyn_core::named::by_name;
/// let name = |of: u8| ["none", "one"][usize::from(of)];
/// assert_eq!(by_name(&[0, 1], name, "one"), Ok(1));
/// assert_eq!(by_name(&[0, 1], name, "two"), Err("expected one of none, one".to_owned()));
/// ```
///
/// # Errors
/// The names of all.
pub fn by_name<T: Copy>(
    all: &[T],
    name: impl Fn(T) -> &'static str,
    text: &str,
) -> Result<T, String> {
    all.iter().copied().find(|one| name(*one) == text).ok_or_else(|| {
        let names: Vec<&str> = all.iter().map(|one| name(*one)).collect();
        format!("expected one of {}", names.join(", "))
    })
}
