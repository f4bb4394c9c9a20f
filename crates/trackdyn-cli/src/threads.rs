//! The number of threads that a user asks for.

/// The variable that the thread pool reads.
const VARIABLE: &str = "RAYON_NUM_THREADS";

/// More threads than any machine has cores: starting them would take longer than the work.
const MAX_THREADS: usize = 1024;

/// An error where more threads are asked for than any machine can use, or what is no number.
pub fn check() -> Result<(), String> {
    let Some(asked) = std::env::var_os(VARIABLE) else { return Ok(()) };
    let number = asked.to_str().and_then(|text| text.parse::<usize>().ok());
    match number {
        Some(number) if number <= MAX_THREADS => Ok(()),
        _ => Err(format!(
            "{VARIABLE} = {}: expected 0 (as many threads as cores) to {MAX_THREADS}",
            asked.to_string_lossy()
        )),
    }
}
