//! Schedules, sensors and the path tracker around a robot of constant ICRs.

mod encoder;
mod imu;
mod plant;
mod pose_sensor;
mod reproducible;
mod schedules;
mod sensor_files;
mod tracking;
