//! Connectivity in linear time: half-edges bucketed by origin, twins matched across buckets.

use super::{NONE, check::diagnose_edges, face_of, next, previous};
use crate::Error;

/// Buckets longer than this are sorted, so that a vertex with very many neighbours costs no more than `n log n`.
const SORTED_BUCKET: usize = 16;

/// A half-edge in the bucket of its origin.
#[derive(Clone, Copy, Default, PartialEq, Eq, PartialOrd, Ord)]
struct Spoke {
    tip: u32,
    halfedge: u32,
}

/// Half-edges grouped by origin.
struct Buckets {
    starts: Vec<u32>,
    spokes: Vec<Spoke>,
}

impl Buckets {
    fn new(vertex_count: usize, faces: &[[u32; 3]]) -> Self {
        let origins = faces.as_flattened();
        let mut starts = vec![0u32; vertex_count + 1];
        for &v in origins {
            starts[v as usize + 1] += 1;
        }
        for v in 0..vertex_count {
            starts[v + 1] += starts[v];
        }
        let mut cursor = starts.clone();
        let mut spokes = vec![Spoke::default(); origins.len()];
        for (face, &[a, b, c]) in faces.iter().enumerate() {
            for (k, (origin, tip)) in [(a, b), (b, c), (c, a)].into_iter().enumerate() {
                let slot = &mut cursor[origin as usize];
                spokes[*slot as usize] = Spoke {
                    tip,
                    halfedge: (3 * face + k) as u32,
                };
                *slot += 1;
            }
        }
        let mut buckets = Self { starts, spokes };
        for v in 0..vertex_count {
            let bucket = buckets.range(v as u32);
            if bucket.len() > SORTED_BUCKET {
                buckets.spokes[bucket].sort_unstable();
            }
        }
        buckets
    }

    fn range(&self, v: u32) -> std::ops::Range<usize> {
        self.starts[v as usize] as usize..self.starts[v as usize + 1] as usize
    }

    fn of(&self, v: u32) -> &[Spoke] {
        &self.spokes[self.range(v)]
    }

    /// The half-edge from `a` to `b`.
    fn find(&self, a: u32, b: u32) -> Option<u32> {
        let bucket = self.of(a);
        if bucket.len() > SORTED_BUCKET {
            bucket
                .binary_search_by_key(&b, |s| s.tip)
                .ok()
                .map(|i| bucket[i].halfedge)
        } else {
            bucket.iter().find(|s| s.tip == b).map(|s| s.halfedge)
        }
    }

    /// Whether some directed edge at `v` occurs twice.
    fn has_repeated_edge(&self, v: u32) -> bool {
        let bucket = self.of(v);
        if bucket.len() > SORTED_BUCKET {
            bucket.windows(2).any(|pair| pair[0].tip == pair[1].tip)
        } else {
            (1..bucket.len()).any(|i| bucket[..i].iter().any(|s| s.tip == bucket[i].tip))
        }
    }
}

/// The twin of each half-edge and the first outgoing half-edge of each vertex.
pub(super) fn connect(
    vertex_count: usize,
    faces: &[[u32; 3]],
) -> Result<(Vec<u32>, Vec<u32>), Error> {
    let buckets = Buckets::new(vertex_count, faces);
    let vertices = 0..vertex_count as u32;
    // Three faces at an edge run along it in at most two directions, so this one test sees both rules on edges.
    if vertices.clone().any(|v| buckets.has_repeated_edge(v)) {
        return Err(diagnose_edges(faces));
    }
    let mut twins = vec![NONE; 3 * faces.len()];
    for a in vertices.clone() {
        for &Spoke { tip: b, halfedge } in buckets.of(a) {
            if a < b
                && let Some(twin) = buckets.find(b, a)
            {
                twins[halfedge as usize] = twin;
                twins[twin as usize] = halfedge;
            }
        }
    }
    let mut outgoing = vec![NONE; vertex_count];
    for v in vertices {
        let bucket = buckets.of(v);
        let Some(any) = bucket.first() else { continue };
        // On the boundary the fan begins where nothing lies clockwise.
        let first = bucket
            .iter()
            .map(|s| s.halfedge)
            .find(|&h| twins[h as usize] == NONE)
            .unwrap_or(any.halfedge);
        outgoing[v as usize] = first;
        let fan = fan(&twins, first);
        if fan.clone().count() < bucket.len() {
            let other = bucket
                .iter()
                .map(|s| s.halfedge)
                .find(|&h| fan.clone().all(|g| g != h));
            let faces = [face_of(first), face_of(other.unwrap_or(first))];
            return Err(Error::NonManifoldVertex { vertex: v, faces });
        }
    }
    debug_assert!(
        faces.as_flattened().iter().enumerate().all(|(h, &v)| {
            twins[h] == NONE || faces.as_flattened()[next(twins[h]) as usize] == v
        })
    );
    Ok((twins, outgoing))
}

/// Outgoing half-edges counter-clockwise from `first`, to the boundary or round to `first` again.
fn fan(twins: &[u32], first: u32) -> impl Iterator<Item = u32> + Clone {
    std::iter::successors(Some(first), move |&h| {
        let onward = twins[previous(h) as usize];
        (onward != NONE && onward != first).then_some(onward)
    })
}
