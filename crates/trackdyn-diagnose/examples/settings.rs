//! Prints docs/theory/diagnosis/settings.md.

fn main() {
    print!("{}", trackdyn_diagnose::settings::page());
}
