//! STEP files as text: every reference is defined, neighbours share edges. What OpenCascade makes of them
//! is checked by `xtask/scripts/read_step.py`.

use std::collections::{BTreeMap, BTreeSet};

use bezier_mass::MassPoint;
use glam::{DVec3, dvec3};

use super::writer::{quoted, real};
use super::*;

/// A quarter of a quarter of the torus of radii 3 and 1, from two quarter circles as rational quadratics.
pub(crate) fn torus_quarter(quarter: usize) -> BezierPatch<DVec3> {
    let half = std::f64::consts::FRAC_1_SQRT_2;
    let corner = |i: usize| {
        [
            dvec3(1.0, 0.0, 0.0),
            dvec3(0.0, 1.0, 0.0),
            dvec3(-1.0, 0.0, 0.0),
            dvec3(0.0, -1.0, 0.0),
        ][i % 4]
    };
    let around = [
        corner(quarter),
        corner(quarter) + corner(quarter + 1),
        corner(quarter + 1),
    ];
    let section = [(4.0, 0.0), (4.0, 1.0), (3.0, 1.0)];
    let weights = [1.0, half, 1.0];
    let mut control = Vec::new();
    for (direction, u_weight) in around.iter().zip(weights) {
        for ((radius, height), v_weight) in section.iter().zip(weights) {
            let point = *direction * *radius + DVec3::Z * *height;
            control.push(MassPoint::point(point, u_weight * v_weight));
        }
    }
    BezierPatch::new([2, 2], control).unwrap()
}

/// The entities of a file by number.
fn entities(text: &str) -> BTreeMap<usize, String> {
    let lines = text
        .lines()
        .filter_map(|line| line.strip_prefix('#')?.split_once('='));
    lines
        .map(|(id, content)| {
            (
                id.parse().unwrap(),
                content.trim_end_matches(';').to_owned(),
            )
        })
        .collect()
}

fn references(content: &str) -> BTreeSet<usize> {
    let digits = content.split('#').skip(1);
    digits
        .map(|rest| {
            rest.split(|c: char| !c.is_ascii_digit())
                .next()
                .unwrap()
                .parse()
                .unwrap()
        })
        .collect()
}

fn count(text: &str, entity: &str) -> usize {
    entities(text)
        .values()
        .filter(|content| content.starts_with(entity))
        .count()
}

#[test]
fn references_are_defined_before_use_and_neighbours_share_edges() {
    let mut step = Step::new("torus");
    for quarter in 0..4 {
        step.patch(&torus_quarter(quarter)).unwrap();
    }
    let text = step.text();
    for (id, content) in entities(&text) {
        assert!(
            references(&content).iter().all(|used| *used < id),
            "#{id}={content}"
        );
    }
    assert_eq!(count(&text, "ADVANCED_FACE"), 4);
    // Four arcs between the quarters, two rings of four; every vertex belongs to two quarters.
    assert_eq!(count(&text, "EDGE_CURVE"), 12);
    assert_eq!(count(&text, "VERTEX_POINT"), 8);
    let uses = |sense: &str| {
        let all = entities(&text);
        let used = all
            .values()
            .filter(|c| c.starts_with("ORIENTED_EDGE") && c.ends_with(sense));
        used.map(|c| references(c).into_iter().next().unwrap())
            .collect::<Vec<_>>()
    };
    let (forwards, backwards) = (uses(".T.)"), uses(".F.)"));
    assert_eq!(forwards.len() + backwards.len(), 16);
    assert_eq!(
        forwards
            .iter()
            .filter(|edge| backwards.contains(edge))
            .count(),
        4,
        "shared edges run both ways"
    );
    assert!(text == step.text());
}

#[test]
fn vectors_negative_weights_and_closed_patches_are_cut() {
    // A half turn as one quadratic with a vector in the middle, swept along a segment: a half cylinder.
    let rows = [
        (dvec3(1.0, 0.0, 0.0), 1.0),
        (dvec3(0.0, 1.0, 0.0), 0.0),
        (dvec3(-1.0, 0.0, 0.0), 1.0),
    ]
    .map(|(p, w)| {
        [0.0, 2.0].map(|z| {
            if w == 0.0 {
                MassPoint::vector(p)
            } else {
                MassPoint::point(p + DVec3::Z * z, w)
            }
        })
    });
    let half_cylinder = BezierPatch::from_rows(&rows).unwrap();
    let mut step = Step::new("half cylinder");
    step.patch(&half_cylinder).unwrap();
    assert_eq!(step.face_count(), 2);
    let negated = BezierPatch::new(
        [2, 1],
        half_cylinder.control().iter().map(|m| -*m).collect(),
    )
    .unwrap();
    let mut other = Step::new("half cylinder");
    other.patch(&negated).unwrap();
    assert!(other.text() == step.text());
    // Two branches of a hyperbola: the patch goes through infinity.
    let rows = [1.0, -1.0].map(|w| [0.0, 1.0].map(|z| MassPoint::point(dvec3(w, 0.0, z), w)));
    let broken = BezierPatch::from_rows(&rows).unwrap();
    assert!(step.patch(&broken).is_err());
    assert_eq!(
        step.face_count(),
        2,
        "a refused patch leaves nothing behind"
    );
}

#[test]
fn a_side_that_is_a_point_has_no_edge() {
    let control = [[DVec3::Z, DVec3::Z], [DVec3::X, DVec3::Y]];
    let rows = control.map(|row| row.map(|point| MassPoint::point(point, 1.0)));
    let mut step = Step::new("triangle");
    step.patch(&BezierPatch::from_rows(&rows).unwrap()).unwrap();
    assert_eq!(count(&step.text(), "EDGE_CURVE"), 3);
}

#[test]
fn reals_and_texts_have_the_right_form() {
    assert_eq!(
        [1.0, 0.5, 1e-7, 1.5e300, -0.0].map(real),
        ["1.0", "0.5", "1.E-7", "1.5E300", "0.0"]
    );
    assert_eq!(quoted("Bézier's"), "'B_zier''s'");
}
