//! The report of a diagnosis and its figures.

use super::Subject;
use crate::earlier::remove_of;
use crate::stderr::say;
use std::path::Path;
use trackdyn::crates::core::output::{fingerprint, write_file};
use trackdyn::crates::diagnose::{Diagnosis, DiagnosisFile};
use trackdyn::crates::model::VehicleFile;
use trackdyn::crates::report::{diagnosis_figures, diagnosis_html};

/// The one figure that not every diagnosis has.
const PATH: &str = "path.png";

/// Writes report.html and its figures.
pub fn write(
    diagnosis: &Diagnosis,
    subject: &Subject,
    vehicle: &VehicleFile,
    file: &DiagnosisFile,
    folder: &Path,
) -> Result<(), Box<dyn std::error::Error>> {
    let caption = format!(
        "trackdyn {}, recording {} {}, vehicle {} {}",
        env!("CARGO_PKG_VERSION"),
        subject.name,
        subject.fingerprint,
        vehicle.vehicle.name,
        fingerprint(vehicle.to_toml().as_bytes())
    );
    let subject = trackdyn::crates::report::Subject {
        diagnosis,
        vehicle,
        file,
        name: &subject.name,
        caption: &caption,
    };
    let figures = diagnosis_figures(&subject)?;
    for figure in &figures {
        write_file(&folder.join(figure.file), &figure.png)?;
    }
    let report = folder.join("report.html");
    // points have no path
    if figures.iter().all(|figure| figure.file != PATH) {
        remove_of(&report, [folder.join(PATH)])?;
    }
    write_file(&report, diagnosis_html(&subject, &figures)?.as_bytes())?;
    say(format_args!("wrote {} and {} figures beside it", report.display(), figures.len()));
    Ok(())
}
