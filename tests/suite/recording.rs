//! Readers, segments, clock offset and noise, on files and on synthetic recordings.

mod clock;
mod folder;
mod noise;
mod parquet;
mod real;
mod rosbag;
mod segments;
mod tables;
mod turns_and_chains;
