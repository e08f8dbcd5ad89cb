//! Readings of a real ribbon from a file.

use std::path::Path;

use anyhow::{Context as _, Result, ensure};
use glam::{DVec2, DVec3, dvec2, dvec3};
use reconstruct::{RibbonLayout, Sensor, SensorKind, WorldFields};

use super::largest;
use crate::color::{BLUE, VERMILION};
use crate::demo::{Context, OrBadInput as _};
use crate::export::Part;
use crate::figure::{Figure, Marker, Plot};
use crate::mesh::Mesh;
use crate::report::Target;

/// A ribbon from a file of readings.
pub(super) fn draw(context: &mut Context, path: &Path, dip: f64) -> Result<()> {
    let text =
        std::fs::read_to_string(path).or_bad_input(format!("--readings {}", path.display()))?;
    let (sensors, readings) =
        parse(&text).or_bad_input(format!("--readings {}", path.display()))?;
    let reconstructed = || -> Result<_> {
        let layout = RibbonLayout::new(sensors, WorldFields::with_dip(dip.to_radians())?)?;
        let tangents = layout.tangents(&readings)?;
        let ribbon = tangents.ribbon()?;
        let covariance = tangents.position_covariance(&ribbon, 0.005)?;
        Ok((ribbon, covariance))
    };
    let (ribbon, covariance) = reconstructed().or_bad_input("--readings")?;
    let points = ribbon.points();
    let plots = [("from above", 0, 1), ("from the side", 0, 2)].map(|(title, x, y)| {
        let mut plot = Plot::geometry(title);
        let flat: Vec<DVec2> = points.iter().map(|p| dvec2(p[x], p[y])).collect();
        plot.polyline(&flat, BLUE.line().width(2.0));
        plot.points(&flat, Marker::Dot, VERMILION.fill());
        plot
    });
    context.figure(
        "figure-readings",
        &Figure::grid(2, plots.to_vec()),
        "The ribbon of the given readings, from above and from the side.",
        "Two views of a curve with dots at its sensors.",
    )?;
    let size = largest(points.iter().map(|p| p.length()));
    let tube = Mesh::tube(points, 0.01 * size, false);
    context.meshes("readings", &[Part::new("ribbon", &tube, BLUE)])?;
    let end = covariance.last().context("a ribbon has points")?;
    let sigma = (end.x_axis.x + end.y_axis.y + end.z_axis.z).sqrt();
    context.number("readings_end_sigma_at_0.005", sigma, Target::Free);
    Ok(())
}

/// Lines `s,kind,x,y,z`; empty lines, comments (`#`) and a heading are skipped.
fn parse(text: &str) -> Result<(Vec<Sensor>, Vec<DVec3>)> {
    let (mut sensors, mut readings) = (Vec::new(), Vec::new());
    for (number, line) in (1..).zip(text.lines()) {
        let cells: Vec<&str> = line.split([',', ';', '\t']).map(str::trim).collect();
        let heading = sensors.is_empty() && cells[0].parse::<f64>().is_err();
        if line.trim().is_empty() || line.starts_with('#') || heading {
            continue;
        }
        ensure!(
            cells.len() == 5,
            "line {number} has {} cells, not s,kind,x,y,z",
            cells.len()
        );
        let value = |k: usize| {
            cells[k]
                .parse::<f64>()
                .with_context(|| format!("line {number}: {:?} is not a number", cells[k]))
        };
        let kind = match cells[1] {
            "a" => SensorKind::Accelerometer,
            "m" => SensorKind::Magnetometer,
            other => anyhow::bail!("line {number}: the kind {other:?} is neither a nor m"),
        };
        sensors.push(Sensor::new(value(0)?, kind));
        readings.push(dvec3(value(2)?, value(3)?, value(4)?));
    }
    Ok((sensors, readings))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn readings_files_are_read_or_refused_with_the_line() {
        let (sensors, readings) =
            parse("s,kind,x,y,z\n0,a,0,0,1\n\n# noise\n0.1,m,0,0.5,-0.8\n").unwrap();
        assert_eq!((sensors.len(), readings[1]), (2, dvec3(0.0, 0.5, -0.8)));
        for bad in ["0,a,0,0,1\n1,b,0,0,1", "0,a,0,0", "0,a,0,0,1\n1,a,zero,0,1"] {
            assert!(
                parse(bad).is_err_and(|error| error.to_string().contains("line")),
                "{bad}"
            );
        }
    }
}
