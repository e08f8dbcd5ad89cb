//! Many queries at once: on all cores with the feature `rayon`, one after the other without it. The answers are the same.

#[cfg(feature = "rayon")]
use rayon::iter::{IntoParallelRefIterator, ParallelIterator};

use crate::{Error, GeodesicPath, Mesh, PathFinder, SurfacePoint, Sweep};

/// A locally shortest path for each pair of points, in their order; see [`PathFinder::shortest`].
///
/// ```
/// use geodesic::{shapes, shortest_paths};
/// let torus = shapes::torus(2.0, 0.7, 24, 12)?;
/// let paths = shortest_paths(&torus, &[[0.into(), 9.into()], [5.into(), 77.into()]]);
/// assert!(paths.iter().all(|path| path.as_ref().is_ok_and(|path| path.length() > 0.0)));
/// # Ok::<(), geodesic::Error>(())
/// ```
#[must_use]
pub fn shortest_paths(
    mesh: &Mesh,
    pairs: &[[SurfacePoint; 2]],
) -> Vec<Result<GeodesicPath, Error>> {
    map_with(
        pairs,
        || PathFinder::new(mesh),
        |finder, &[from, to]| finder.shortest(from, to).cloned(),
    )
}

/// The exact distance for each pair of points, in their order; see [`Sweep::distance`].
#[must_use]
pub fn exact_distances(mesh: &Mesh, pairs: &[[SurfacePoint; 2]]) -> Vec<Result<f64, Error>> {
    map_with(
        pairs,
        || Sweep::new(mesh),
        |sweep, &[from, to]| sweep.distance(from, to),
    )
}

/// The exact distances of all vertices from each of the points alone, in their order; see [`Sweep::vertex_distances`].
#[must_use]
pub fn exact_distances_to_all(
    mesh: &Mesh,
    sources: &[SurfacePoint],
) -> Vec<Result<Vec<f64>, Error>> {
    map_with(
        sources,
        || Sweep::new(mesh),
        |sweep, &source| sweep.vertex_distances(&[source]).map(<[f64]>::to_vec),
    )
}

/// Answers queries with one worker a thread.
#[cfg(feature = "rayon")]
fn map_with<Q: Sync, W, A: Send>(
    queries: &[Q],
    worker: impl Fn() -> W + Sync + Send,
    answer: impl Fn(&mut W, &Q) -> A + Sync + Send,
) -> Vec<A> {
    queries.par_iter().map_init(worker, answer).collect()
}

/// Answers queries with one worker.
#[cfg(not(feature = "rayon"))]
fn map_with<Q, W, A>(
    queries: &[Q],
    worker: impl Fn() -> W,
    answer: impl Fn(&mut W, &Q) -> A,
) -> Vec<A> {
    let mut worker = worker();
    queries
        .iter()
        .map(|query| answer(&mut worker, query))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shapes;

    #[test]
    fn batches_answer_as_single_queries_do() {
        let mesh = shapes::plate(2, 1).unwrap();
        let count = mesh.vertex_count() as u32;
        let pairs: Vec<[SurfacePoint; 2]> = (0..40)
            .map(|i| [(i * 7919 % count).into(), (i * 104_729 % count).into()])
            .chain([[0.into(), u32::MAX.into()]])
            .collect();
        let (mut finder, mut sweep) = (PathFinder::new(&mesh), Sweep::new(&mesh));
        let (paths, distances) = (
            shortest_paths(&mesh, &pairs),
            exact_distances(&mesh, &pairs),
        );
        let sources: Vec<SurfacePoint> = pairs.iter().map(|pair| pair[0]).collect();
        let fields = exact_distances_to_all(&mesh, &sources);
        for (i, &[from, to]) in pairs.iter().enumerate() {
            assert_eq!(paths[i], finder.shortest(from, to).cloned());
            assert_eq!(distances[i], sweep.distance(from, to));
            if let (Ok(distance), SurfacePoint::Vertex(v)) = (&distances[i], to) {
                let field = fields[i].as_ref().unwrap();
                assert!((field[v as usize] - distance).abs() <= 1e-12);
            }
        }
    }
}
