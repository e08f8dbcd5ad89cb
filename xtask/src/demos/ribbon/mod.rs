//! Curves from tangents alone (Figs 3.2 to 3.7 of the chapter on sensors).
//!
//! What one sees: first three ways to ask for a curve, by points with tangents, by tangent lines, and by tangent
//! directions at given arc lengths, which is what sensors know. Then a plane curve from 17 and 33 sensors over the true
//! one, with noisy readings and the ellipses in which the theory expects the points to scatter; a space curve in two
//! views; and how the error falls with the number of sensors, with slope 4 for not-a-knot ends and 3 for natural ones.

mod frames;
mod orders;
mod planar;
mod readings;
mod space;

pub(crate) use frames::alternating;

use std::path::PathBuf;

use anyhow::Result;
use glam::{DVec3, dvec3};
use reconstruct::{EndCondition, PlanarRibbon, SpatialRibbon, TangentMethod};

use crate::demo::{Context, Demo};

#[derive(clap::Args, Debug)]
pub(super) struct Ribbon {
    /// Readings of a real ribbon: lines `s,kind,x,y,z` with kind `a` (accelerometer) or `m` (magnetometer)
    #[arg(long, value_name = "FILE.csv")]
    readings: Option<PathBuf>,
    /// Dip of the magnetic field below the horizontal for --readings, in degrees
    #[arg(long, default_value_t = 62.0, allow_negative_numbers = true)]
    dip: f64,
}

/// Length of the test curves.
const LENGTH: f64 = 4.0;

impl Demo for Ribbon {
    const NAME: &'static str = "ribbon";
    const PAPER: &'static str = "ph-geodesic-variation-wavefront, Figs 3.2 to 3.7";
    const ABOUT: &'static str =
        "Plane and space curves reconstructed from orientation sensors on a ribbon";

    fn run(&self, context: &mut Context) -> Result<()> {
        if let Some(path) = &self.readings {
            readings::draw(context, path, self.dip)?;
        }
        planar::draw_problems(context)?;
        planar::draw(context)?;
        space::draw(context)?;
        orders::draw(context)?;
        frames::time(context)
    }
}

/// The plane test curve: its tangent angle.
fn angle(s: f64) -> f64 {
    0.4 + 1.5 * (1.6 * s).sin() + 0.35 * s
}

/// The space test curve: its unit tangent.
fn tangent(s: f64) -> DVec3 {
    let (polar, azimuth) = (
        1.0 + 0.45 * (1.3 * s).sin(),
        0.3 + 1.2 * s + 0.2 * (2.1 * s).cos(),
    );
    dvec3(
        polar.sin() * azimuth.cos(),
        polar.sin() * azimuth.sin(),
        polar.cos(),
    )
}

fn places(intervals: usize) -> Vec<f64> {
    (0..=intervals)
        .map(|i| LENGTH * i as f64 / intervals as f64)
        .collect()
}

fn planar(intervals: usize, end: EndCondition) -> Result<PlanarRibbon> {
    let s = places(intervals);
    let angles: Vec<f64> = s.iter().map(|s| angle(*s)).collect();
    Ok(PlanarRibbon::new(&s, &angles, end)?)
}

fn spatial(intervals: usize, method: TangentMethod, end: EndCondition) -> Result<SpatialRibbon> {
    let s = places(intervals);
    let tangents: Vec<DVec3> = s.iter().map(|s| tangent(*s)).collect();
    Ok(SpatialRibbon::with_method(&s, &tangents, method, end)?)
}

/// Intervals of the reference, 4th order: its error is below 1e-12.
const FINE: usize = 4096;

/// Points of a curve over its whole length, dense enough for a picture.
fn trace<P>(at: impl Fn(f64) -> Result<P, reconstruct::Error>) -> Result<Vec<P>> {
    (0..=600)
        .map(|i| Ok(at(LENGTH * f64::from(i) / 600.0)?))
        .collect()
}

fn largest(values: impl Iterator<Item = f64>) -> f64 {
    values.fold(0.0, f64::max)
}
