//! Loops of a torus by homotopy class.
//!
//! On a closed mesh of genus 1 two integers say how a loop goes round. They are counted by two closed dual curves, found
//! by a tree of edges and a tree of faces that it leaves (Eppstein, *Dynamic generators of topologically embedded
//! graphs*, SODA 2003): a loop's class is how often it crosses each, with sign.

use std::cmp::Reverse;
use std::collections::{BinaryHeap, HashMap};
use std::f64::consts::FRAC_PI_2;

use glam::DVec3;

use crate::loops::{DirectedLoop, GeodesicLoop, LoopFinder};
use crate::mesh::{Mesh, NONE, face_of, next, previous};
use crate::{Error, Straightest, SurfacePoint};

/// Start vertices tried in a search for a short loop, spread evenly over those that every loop of the class passes.
const STARTS: usize = 24;

/// States settled in the search for one loop before it is given up: some hundred megabytes.
const BUDGET: usize = 4_000_000;

/// Turns either way that one search may look for: 16,640 classes.
const LARGEST_TURNS: u32 = 64;

/// The homotopy classes of a torus, with a basis chosen by two loops.
///
/// ```
/// use geodesic::{SurfacePoint, TorusClasses, shapes};
/// let (around, tube) = (24, 12);
/// let torus = shapes::torus(2.0, 0.7, around, tube)?;
/// let parallel: Vec<SurfacePoint> = (0..around).map(SurfacePoint::Vertex).collect();
/// let meridian: Vec<SurfacePoint> = (0..tube).map(|j| SurfacePoint::Vertex(j * around)).collect();
/// let mut classes = TorusClasses::new(&torus, &parallel, &meridian)?;
/// let diagonal = classes.shortest(1, 1)?;
/// assert!(diagonal.certify(&torus)?.is_geodesic());
/// assert!((diagonal.length() - 11.0325).abs() < 0.05); // 11.0325 on the smooth torus
/// # Ok::<(), geodesic::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct TorusClasses<'m> {
    mesh: &'m Mesh,
    finder: LoopFinder<'m>,
    /// How often each half-edge crosses the two dual curves, from right to left.
    crossings: Vec<[i32; 2]>,
    /// The crossings of the two loops that make the basis.
    basis: [[i32; 2]; 2],
}

impl<'m> TorusClasses<'m> {
    /// The classes with a basis: `first` has class (1, 0), `second` (0, 1). Both are closed polylines as in
    /// [`LoopFinder::tighten`].
    ///
    /// # Errors
    ///
    /// [`Error::NotATorus`]; [`Error::NotABasis`] if the loops do not generate all classes; an error about a point.
    pub fn new(
        mesh: &'m Mesh,
        first: &[SurfacePoint],
        second: &[SurfacePoint],
    ) -> Result<Self, Error> {
        let (euler, boundaries) = (mesh.euler_characteristic(), mesh.boundary_edge_count());
        if euler != 0 || boundaries != 0 || mesh.components().iter().any(|&c| c != 0) {
            return Err(Error::NotATorus { euler, boundaries });
        }
        let mut finder = LoopFinder::new(mesh);
        let crossings = dual_curves(mesh);
        let [a, b] = [finder.cycle(first)?, finder.cycle(second)?]
            .map(|cycle| crossings_of(mesh, &crossings, &cycle));
        let determinant = a[0] * b[1] - a[1] * b[0];
        if determinant.abs() != 1 {
            return Err(Error::NotABasis { determinant });
        }
        Ok(Self {
            mesh,
            finder,
            crossings,
            basis: [a, b],
        })
    }

    /// The class of a closed polyline.
    ///
    /// # Errors
    ///
    /// As for [`LoopFinder::tighten`].
    pub fn class_of(&mut self, points: &[SurfacePoint]) -> Result<[i32; 2], Error> {
        let cycle = self.finder.cycle(points)?;
        let [x, y] = crossings_of(self.mesh, &self.crossings, &cycle);
        let [a, b] = self.basis;
        let determinant = a[0] * b[1] - a[1] * b[0];
        Ok([
            (x * b[1] - y * b[0]) * determinant,
            (a[0] * y - a[1] * x) * determinant,
        ])
    }

    /// A closed geodesic of class `(p, q)`: the shortest loop along edges, of those through some vertices, made tight.
    ///
    /// It is certified to be a geodesic, and it belongs to the class. That no other loop of the class is shorter is *not*
    /// proved: tightening ends in the valley where the loop along edges lies, and the vertices tried are a sample. Where `p`
    /// and `q` have a common divisor the shortest loop is that of the primitive class, gone round repeatedly, up to what
    /// vertices in the way make of it.
    ///
    /// # Errors
    ///
    /// [`Error::NullLoop`] for class (0, 0); [`Error::LoopNotFound`] if the search is given up; those of
    /// [`LoopFinder::tighten`].
    pub fn shortest(&mut self, p: i32, q: i32) -> Result<GeodesicLoop, Error> {
        let target = self.crossings_of_class([p, q]);
        let Some(crossed) = (0..2).find(|&k| target[k] != 0) else {
            return Err(Error::NullLoop {
                length: 0.0,
                vertex: 0,
            });
        };
        // Every loop of the class passes a vertex at this dual curve.
        let mut starts: Vec<u32> = (0..self.mesh.halfedge_count() as u32)
            .filter(|&h| self.crossings[h as usize][crossed] != 0)
            .map(|h| self.mesh.origin(h))
            .collect();
        starts.sort_unstable();
        starts.dedup();
        let stride = starts.len().div_ceil(STARTS);
        let mut best: Option<(f64, Vec<SurfacePoint>)> = None;
        let mut settled = 0;
        for &start in starts.iter().step_by(stride) {
            let bound = best.as_ref().map_or(f64::INFINITY, |b| b.0);
            let found = self.shortest_through(start, &[target], bound, &mut settled);
            best = found.into_iter().next().flatten().or(best);
        }
        let (_, points) = best.ok_or(Error::LoopNotFound {
            p,
            q,
            budget: BUDGET,
        })?;
        self.finder.tighten(&points)
    }

    /// Loops of all classes with `|p|, |q| <= largest` held at a point, as answers to "through this point, in this
    /// direction": those that leave the point within a right angle of the direction, with their classes, sorted by the sum of
    /// their residuals.
    ///
    /// A closed geodesic through the point in the direction exists only for special directions; where both residuals vanish
    /// it has been found. [`LoopFinder::through`] looks for the same on meshes of any kind, along one ray. Each loop is
    /// shortest among its neighbours, not proved to be so in its class.
    ///
    /// # Errors
    ///
    /// An error about the point; [`Error::NonFinite`], [`Error::NoTangentialPart`] or [`Error::DirectionLeavesSurface`]
    /// about the direction; [`Error::TooManyClasses`] for `largest` above 64; those of [`LoopFinder::held_at_first`]. A class whose search is given up is left out.
    pub fn through(
        &mut self,
        point: SurfacePoint,
        direction: DVec3,
        largest: u32,
    ) -> Result<Vec<([i32; 2], DirectedLoop)>, Error> {
        let mesh = self.mesh;
        let point = mesh.canonical(point)?;
        if largest > LARGEST_TURNS {
            return Err(Error::TooManyClasses {
                largest,
                limit: LARGEST_TURNS,
            });
        }
        let face = Straightest::new(mesh).find_face_towards(point, direction)?;
        let start = mesh.faces()[face as usize];
        let nearest = |a: &&u32, b: &&u32| {
            let distance = |v: u32| mesh.position(v).distance(mesh.locate(point));
            distance(**a).total_cmp(&distance(**b))
        };
        let start = start.iter().min_by(nearest).copied().unwrap_or(start[0]);
        let largest = largest as i32;
        let classes = (-largest..=largest).flat_map(|p| (-largest..=largest).map(move |q| [p, q]));
        let classes: Vec<[i32; 2]> = classes.filter(|&class| class != [0, 0]).collect();
        let targets: Vec<[i32; 2]> = classes
            .iter()
            .map(|&c| self.crossings_of_class(c))
            .collect();
        let loops = self.shortest_through(start, &targets, f64::INFINITY, &mut 0);
        let mut answers = Vec::new();
        for (class, found) in classes.into_iter().zip(loops) {
            let Some((_, mut points)) = found else {
                continue;
            };
            // From the point to the vertex, round, and back to the point in the same face.
            if point != SurfacePoint::Vertex(start) {
                points.push(start.into());
                points.insert(0, point);
            }
            let geodesic = self.finder.held_at_first(&points)?;
            let answer = DirectedLoop::new(mesh, point, direction, geodesic);
            if answer.direction_residual <= FRAC_PI_2 {
                answers.push((class, answer));
            }
        }
        answers.sort_by(|a, b| a.1.residual().total_cmp(&b.1.residual()));
        Ok(answers)
    }

    /// How often loops of a class cross the dual curves.
    fn crossings_of_class(&self, [p, q]: [i32; 2]) -> [i32; 2] {
        let [a, b] = self.basis;
        [0, 1].map(|k| {
            p.saturating_mul(a[k])
                .saturating_add(q.saturating_mul(b[k]))
        })
    }

    /// For each of the given crossings, the shortest loop along edges through a vertex that has them, if it is shorter than
    /// `bound`, with its length.
    fn shortest_through(
        &self,
        start: u32,
        targets: &[[i32; 2]],
        bound: f64,
        settled: &mut usize,
    ) -> Vec<Option<(f64, Vec<SurfacePoint>)>> {
        // A vertex of the covering plane: the vertex and the crossings on the way to it.
        type Sheet = (u32, [i32; 2]);
        let mut known: HashMap<Sheet, (f64, Sheet)> = HashMap::new();
        let mut heap = BinaryHeap::new();
        let origin = (start, [0, 0]);
        known.insert(origin, (0.0, origin));
        heap.push(Reverse((0u64, origin)));
        let mut loops = vec![None; targets.len()];
        let mut wanted: HashMap<[i32; 2], usize> = targets.iter().copied().zip(0..).collect();
        while let Some(Reverse((key, here))) = heap.pop() {
            let distance = f64::from_bits(key);
            if wanted.is_empty() || distance >= bound || *settled >= BUDGET {
                break;
            }
            if known.get(&here).is_some_and(|k| k.0 < distance) {
                continue;
            }
            *settled += 1;
            if here.0 == start
                && let Some(target) = wanted.remove(&here.1)
            {
                let mut points = Vec::new();
                let mut at = here;
                while let Some(&(_, before)) = known.get(&at).filter(|k| k.1 != at) {
                    points.push(SurfacePoint::Vertex(before.0));
                    at = before;
                }
                points.reverse();
                loops[target] = Some((distance, points));
            }
            for h in self.mesh.star(here.0) {
                let [x, y] = self.crossings[h as usize];
                let there = (self.mesh.tip(h), [here.1[0] + x, here.1[1] + y]);
                let length = distance + self.mesh.length(h);
                let entry = known.entry(there).or_insert((f64::INFINITY, here));
                if length < entry.0 {
                    *entry = (length, here);
                    heap.push(Reverse((length.to_bits(), there)));
                }
            }
        }
        loops
    }
}

/// Two dual curves that generate the crossings of all loops.
fn dual_curves(mesh: &Mesh) -> Vec<[i32; 2]> {
    let mut in_tree = vec![false; mesh.halfedge_count()];
    let mark = |h: u32, marks: &mut Vec<bool>| {
        marks[h as usize] = true;
        mesh.twin(h)
            .into_iter()
            .for_each(|twin| marks[twin as usize] = true);
    };
    // A tree of edges that reaches every vertex.
    let mut reached = vec![false; mesh.vertex_count()];
    let mut queue = std::collections::VecDeque::from([mesh.origin(0)]);
    reached[mesh.origin(0) as usize] = true;
    while let Some(v) = queue.pop_front() {
        for h in mesh.star(v) {
            if !std::mem::replace(&mut reached[mesh.tip(h) as usize], true) {
                mark(h, &mut in_tree);
                queue.push_back(mesh.tip(h));
            }
        }
    }
    // A tree of faces that crosses none of them: the portal through which each face was entered.
    let mut entered = vec![NONE; mesh.face_count()];
    let mut depth = vec![0u32; mesh.face_count()];
    let mut visited = vec![false; mesh.face_count()];
    let mut queue = std::collections::VecDeque::from([0]);
    visited[0] = true;
    while let Some(f) = queue.pop_front() {
        for h in 3 * f..3 * f + 3 {
            let Some(twin) = mesh.twin(h).filter(|_| !in_tree[h as usize]) else {
                continue;
            };
            let g = face_of(twin) as usize;
            if !std::mem::replace(&mut visited[g], true) {
                mark(h, &mut in_tree);
                entered[g] = h;
                depth[g] = depth[f as usize] + 1;
                queue.push_back(g as u32);
            }
        }
    }
    // Each edge in neither tree closes a dual curve.
    let mut crossings = vec![[0, 0]; mesh.halfedge_count()];
    let mut curve = 0;
    for h in 0..mesh.halfedge_count() as u32 {
        let Some(twin) = mesh
            .twin(h)
            .filter(|&twin| h < twin && !in_tree[h as usize])
        else {
            continue;
        };
        if curve == 2 {
            break;
        }
        let mut cross = |portal: u32, sign: i32| {
            crossings[portal as usize][curve] += sign;
            mesh.twin(portal)
                .into_iter()
                .for_each(|t| crossings[t as usize][curve] -= sign);
        };
        cross(h, 1);
        // From the face behind the edge back to the one before it, by way of the tree.
        let (mut ahead, mut behind) = (face_of(twin), face_of(h));
        while ahead != behind {
            if depth[ahead as usize] >= depth[behind as usize] {
                cross(entered[ahead as usize], -1);
                ahead = face_of(entered[ahead as usize]);
            } else {
                cross(entered[behind as usize], 1);
                behind = face_of(entered[behind as usize]);
            }
        }
        curve += 1;
    }
    crossings
}

/// The crossings of a closed sequence of portals: those of the vertices along its right side.
fn crossings_of(mesh: &Mesh, crossings: &[[i32; 2]], cycle: &[u32]) -> [i32; 2] {
    let mut sum = [0, 0];
    for (i, &portal) in cycle.iter().enumerate() {
        let onward = cycle[(i + 1) % cycle.len()];
        if let Some(twin) = mesh.twin(portal)
            && onward == previous(twin)
        {
            let [x, y] = crossings[next(twin) as usize];
            sum = [sum[0] + x, sum[1] + y];
        }
    }
    sum
}
