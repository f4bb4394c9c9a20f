//! Prints docs/trials/forms.md.

fn main() {
    print!("{}", trackdyn_second_simulator::page());
}
