//! A batch gives what its members give, in their order; with the feature `rayon` too.

use cyclide::glam::{DVec3, dvec3};
use cyclide::{Dupin, Frame};

#[test]
fn a_batch_of_lines_answers_as_each_line_does() -> Result<(), cyclide::Error> {
    let surface = Dupin::quartic(3.0, 1.0, 2.0, Frame::WORLD)?;
    let lines: Vec<(DVec3, DVec3)> = (0..1000)
        .map(|i| {
            let t = 0.01 * f64::from(i);
            let direction = if i % 100 == 99 {
                DVec3::ZERO // refused alone, not with its neighbours
            } else {
                dvec3(1.0, 0.3 * t.sin(), 0.2 * (3.0 * t).cos())
            };
            (dvec3(-9.0, t.cos(), 0.5 * t.sin()), direction)
        })
        .collect();
    let batch = surface.intersect_all(&lines);
    assert_eq!(batch.len(), lines.len());
    for (found, &(origin, direction)) in batch.iter().zip(&lines) {
        match (found, surface.intersect(origin, direction)) {
            (Ok(found), Ok(alone)) => {
                assert_eq!(found.len(), alone.len());
                for (one, other) in found.iter().zip(alone.iter()) {
                    assert_eq!(one.s, other.s);
                }
            }
            (Err(_), Err(_)) => assert_eq!(direction, DVec3::ZERO),
            (found, alone) => panic!("{found:?} in the batch, {alone:?} alone"),
        }
    }
    Ok(())
}
