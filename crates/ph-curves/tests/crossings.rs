//! Crossings of splines with themselves, against those of dense polylines.

#[path = "common/walk.rs"]
mod walk;

use ph_curves::glam::{DVec2, dvec2};
use ph_curves::{Approximation, ArcSpline, CubicPath, approximate};
use walk::walk;

/// Chords per piece.
const CHORDS: usize = 48;
/// Chords that meet at a smaller sine can belong to a contact, or to a crossing in a piece's own cusp.
const LEAST_SINE: f64 = 0.1;

/// A chord with the piece and the parameter at which it begins.
struct Chord {
    piece: usize,
    from: f64,
    ends: [DVec2; 2],
}

fn chords(spline: &ArcSpline) -> Vec<Chord> {
    let step = 1.0 / CHORDS as f64;
    let chord = |piece: usize, k: usize| {
        let [from, to] = [k, k + 1].map(|k| k as f64 * step);
        let arc = &spline.pieces()[piece];
        Chord {
            piece,
            from,
            ends: [arc.point(from), arc.point(to)],
        }
    };
    (0..spline.pieces().len())
        .flat_map(|piece| (0..CHORDS).map(move |k| chord(piece, k)))
        .collect()
}

/// Where two chords cross clearly, inside of both and at a good angle.
fn meeting(a: &Chord, b: &Chord) -> Option<DVec2> {
    let (u, v) = (a.ends[1] - a.ends[0], b.ends[1] - b.ends[0]);
    let between = b.ends[0] - a.ends[0];
    let determinant = u.perp_dot(v);
    let (t, s) = (
        between.perp_dot(v) / determinant,
        between.perp_dot(u) / determinant,
    );
    let inside = |x: f64| (0.05..0.95).contains(&x);
    let clear = determinant.abs() > LEAST_SINE * u.length() * v.length();
    (clear && inside(t) && inside(s)).then(|| a.ends[0] + u * t)
}

#[test]
fn every_clear_crossing_of_chords_is_a_crossing_of_arcs() {
    let (mut seen, mut found) = (0, 0);
    for seed in 0..48 {
        let how = match seed % 3 {
            0 => Approximation::within(1e-5),
            1 => Approximation::fewest(1e-5),
            _ => Approximation::quartics(1e-3),
        };
        let spline = approximate(&walk(seed, 14, seed % 2 == 0), &how)
            .unwrap()
            .spline;
        let spline = spline.offset([0.0, 0.4, -0.7][seed as usize % 3]).unwrap();
        let crossings = spline.crossings();
        for crossing in &crossings {
            let [(i, t), (j, s)] = [crossing.first, crossing.second];
            let (a, b) = (spline.pieces()[i].point(t), spline.pieces()[j].point(s));
            assert!((a - b).length() < 1e-12, "seed {seed}: {crossing:?}");
            assert!((a - crossing.point).length() < 1e-12);
        }
        found += crossings.len();
        let chords = chords(&spline);
        for (k, a) in chords.iter().enumerate() {
            for b in chords.iter().skip(k + 2) {
                let Some(point) = meeting(a, b) else {
                    continue;
                };
                seen += 1;
                let longest = (a.ends[1] - a.ends[0])
                    .length()
                    .max((b.ends[1] - b.ends[0]).length());
                let known = crossings
                    .iter()
                    .any(|c| (c.point - point).length() <= longest);
                assert!(
                    known,
                    "seed {seed}: pieces {} {:.3} and {} {:.3}",
                    a.piece, a.from, b.piece, b.from
                );
            }
        }
    }
    assert!(seen > 300 && found >= seen, "{seen} seen, {found} found");
}

#[test]
fn the_sides_of_a_corner_cross_in_its_inner_offset() {
    let corner = [dvec2(0.0, 0.0), dvec2(4.0, 0.0), dvec2(4.0, 4.0)];
    let path = CubicPath::polyline(&corner, false).unwrap();
    let spline = approximate(&path, &Approximation::within(1e-6))
        .unwrap()
        .spline;
    let only_crossing = |spline: &ArcSpline| {
        let crossings = spline.crossings();
        assert_eq!(crossings.len(), 1, "{crossings:?}");
        crossings[0].point
    };
    // The travel reverses on the fan of normals between the sides ...
    let inner = spline.offset(-1.0).unwrap();
    assert!((only_crossing(&inner) - dvec2(3.0, 1.0)).length() < 1e-14);
    // ... which a trimmed offset does not have: its sides move apart from their corner, or over it.
    let trimmed = spline.trimmed_offset(-1.0).unwrap();
    assert_eq!(trimmed.len(), 1);
    assert!(trimmed[0].crossings().is_empty());
    let further = trimmed[0].offset(-1.0).unwrap();
    assert!((only_crossing(&further) - dvec2(2.0, 2.0)).length() < 1e-14);
}

#[test]
fn a_cusp_in_a_joint_is_passed_in_the_other_direction() {
    // Seed 95 of the walks: a joint without continuous curvature, at which the radius of the offset changes its sign.
    let spline = approximate(&walk(95, 14, false), &Approximation::quartics(1e-3))
        .unwrap()
        .spline;
    let crossings = spline.offset(-0.7).unwrap().crossings();
    let there = dvec2(1.4825, 6.54453);
    assert!(crossings.iter().any(|c| (c.point - there).length() < 1e-5));
}
