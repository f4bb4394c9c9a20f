//! What we write for other programs, run through their documented equations.

mod diff_drive;
