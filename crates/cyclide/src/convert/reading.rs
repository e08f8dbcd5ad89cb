//! The parameters of a net's edges on a surface that is known.

use crate::{Dupin, tolerance};
use bezier_mass::Biquadratic;
use glam::DVec3;
use std::f64::consts::{PI, TAU};

/// Places along an iso-curve of which the one best between its ends tells the direction of the parameter.
const SAMPLES: u32 = 16;

/// The spans of both parameters of a net whose rows follow the first one, read off along the iso-curves at `line`.
pub(super) fn spans(
    net: &Biquadratic<DVec3>,
    surface: &Dupin,
    line: f64,
) -> Result<[[f64; 2]; 2], bezier_mass::Error> {
    let at = |u: f64, v: f64| net.point(u, v).map(|point| surface.parameters_at(point));
    let Dupin::Quartic(quartic) = surface else {
        return Ok([
            [at(0.0, line)?[0], at(1.0, line)?[0]],
            [at(line, 0.0)?[1], at(line, 1.0)?[1]],
        ]);
    };
    let crossing = at(line, line)?;
    let constant = |angles: [f64; 2], which: usize| {
        if quartic.a() == 0.0 {
            on_sheet(angles, crossing, which)
        } else {
            angles
        }
    };
    let first = span(|t| Ok(constant(at(t, line)?, 1)[0]))?;
    let second = span(|t| Ok(constant(at(line, t)?, 0)[1]))?;
    Ok([reduced(first), reduced(second)])
}

/// On the double sphere `(theta, psi)` and `(theta + pi, pi - psi)` are one point: the pair that keeps the parameter that is constant along
/// an iso-curve through the crossing.
pub(super) fn on_sheet([theta, psi]: [f64; 2], crossing: [f64; 2], constant: usize) -> [f64; 2] {
    let pair = [theta, psi];
    let other = [theta + PI, PI - psi];
    let off = |pair: [f64; 2]| nearest_turn(pair[constant] - crossing[constant], 0.0).abs();
    if off(other) < off(pair) { other } else { pair }
}

/// An angle at the start and at the end of an iso-curve. On a patch it grows or falls all the way, by less than a full turn, so that one
/// place between the ends decides which: the one furthest from both.
fn span(
    angle: impl Fn(f64) -> Result<f64, bezier_mass::Error>,
) -> Result<[f64; 2], bezier_mass::Error> {
    let (start, end) = (angle(0.0)?, angle(1.0)?);
    let ahead = |angle: f64| (angle - start).rem_euclid(TAU);
    let whole = ahead(end);
    let (mut widest, mut grows) = (-1.0, true);
    for step in 1..SAMPLES {
        let between = angle(f64::from(step) / f64::from(SAMPLES))?;
        let gap = [start, end]
            .map(|end| nearest_turn(between - end, 0.0).abs())
            .into_iter()
            .fold(f64::INFINITY, f64::min);
        if gap > widest {
            (widest, grows) = (gap, ahead(between) <= whole);
        }
    }
    Ok([start, start + if grows { whole } else { whole - TAU }])
}

/// The angle equal to `angle` up to full turns that is nearest to `reference`.
fn nearest_turn(angle: f64, reference: f64) -> f64 {
    angle - TAU * ((angle - reference) / TAU).round()
}

/// Both ends shifted by full turns so that the first lies in `[0, 2 pi)`; one that the recovery left below zero is zero.
fn reduced([from, to]: [f64; 2]) -> [f64; 2] {
    let turns = ((from + tolerance::RECOVERED_KIND) / TAU).floor();
    [(from - turns * TAU).max(0.0), to - turns * TAU]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_start_just_below_a_full_turn_is_zero() {
        assert_eq!(reduced([-1e-15, 2.0]), [0.0, 2.0]);
        assert_eq!(reduced([TAU - 1e-12, TAU + 2.0]), [0.0, 2.0]);
        assert_eq!(reduced([TAU, 1.0]), [0.0, 1.0 - TAU]);
        assert_eq!(reduced([-1.0, -2.0]), [TAU - 1.0, TAU - 2.0]);
        assert_eq!(reduced([1e-15, -2.0]), [1e-15, -2.0]);
    }
}
