//! Figures as their readers get them.

mod diagnosis;
mod icr_map;
mod path_tracking;
