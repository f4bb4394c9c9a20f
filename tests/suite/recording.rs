//! Readers, segments, clock offset and noise, on files and on synthetic recordings.

mod arrays_and_interfaces;
mod causes;
mod clock;
mod clocks_and_poses;
mod clocks_of_chains;
mod columns;
pub mod drives;
mod folder;
mod inspections;
mod joints;
mod noise;
mod other_tables;
mod parquet;
mod real;
mod rosbag;
mod segments;
mod signals;
mod sources;
mod tables;
mod turns_and_chains;
mod usual_sources;
