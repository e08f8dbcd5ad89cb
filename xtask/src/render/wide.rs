//! The hierarchy as rays see it: four children a node, four triangles a leaf, all tested at once.
//!
//! obvhs builds a good binary tree. Two of its levels make one level here, and leaves hold four triangles
//! coordinate by coordinate, so that one instruction works on four boxes or triangles: about half the
//! time of walking the binary tree.

use glam::{Vec3A, Vec4};
use obvhs::bvh2::Bvh2;
use obvhs::triangle::Triangle;

/// How far outside a triangle's edge a ray may pass and still hit, in the unit of the scene's ball. Two triangles
/// reckon their common edge with different roundings, of the size of the last bit of the way from the camera (some
/// units) to them; without it pinholes open there.
const EDGE_SLACK: f32 = 8.0 * f32::EPSILON;
/// The most of it in barycentric coordinates, for slivers.
const MOST_SLACK: f32 = 1e-2;
/// Boxes are left later by this factor, which covers the rounding of the three products.
const BOX_SLACK: f32 = 1.0 + 4.0 * f32::EPSILON;
/// A child that is no node: the number that follows is that of a leaf.
const LEAF: u32 = 1 << 31;
/// A child that is not there.
const NONE: u32 = u32::MAX;
/// Open nodes for which there is room without the heap.
const SHALLOW: usize = 64;

/// Boxes of up to four children.
#[derive(Clone, Copy, Debug)]
struct Node {
    low: [Vec4; 3],
    high: [Vec4; 3],
    children: [u32; 4],
}

/// Up to four triangles: a vertex and two edges of each.
#[derive(Clone, Copy, Debug)]
struct Leaf {
    corner: [Vec4; 3],
    edge1: [Vec4; 3],
    edge2: [Vec4; 3],
    /// [`EDGE_SLACK`] in barycentric coordinates of each.
    slack: Vec4,
    triangles: [u32; 4],
}

/// A triangle on a ray.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Crossing {
    pub(super) distance: f32,
    pub(super) triangle: u32,
    /// Weights of the second and third vertex.
    pub(super) weights: [f32; 2],
}

/// The hierarchy over triangles that keep their numbers.
#[derive(Clone, Debug, Default)]
pub(super) struct Tree {
    nodes: Vec<Node>,
    leaves: Vec<Leaf>,
    depth: usize,
}

/// A ray with what every box test needs.
#[derive(Clone, Copy, Debug)]
struct Ray {
    origin: [Vec4; 3],
    direction: [Vec4; 3],
    inverse: [Vec4; 3],
}

impl Ray {
    fn new(origin: Vec3A, direction: Vec3A) -> Self {
        // A direction along an axis gets a large inverse instead of an infinite one: no NaN.
        let inverse = |x: f32| {
            if x.abs() < 1e-12 {
                1e12_f32.copysign(x)
            } else {
                1.0 / x
            }
        };
        Self {
            origin: origin.to_array().map(Vec4::splat),
            direction: direction.to_array().map(Vec4::splat),
            inverse: direction.to_array().map(|x| Vec4::splat(inverse(x))),
        }
    }
}

impl Tree {
    /// The tree over `triangles` from a binary one whose leaves hold at most four.
    pub(super) fn new(binary: &Bvh2, triangles: &[Triangle]) -> Self {
        let mut tree = Self::default();
        if !binary.nodes.is_empty() {
            tree.add(binary, triangles, &[0], 1);
        }
        tree
    }

    /// Adds a node whose children start as the binary nodes `from`; returns its number.
    fn add(&mut self, binary: &Bvh2, triangles: &[Triangle], from: &[usize], depth: usize) -> u32 {
        self.depth = self.depth.max(depth);
        let mut members = from.to_vec();
        // Open the largest inner child until there are four.
        while members.len() < 4 {
            let area = |&member: &usize| binary.nodes[member].aabb().half_area();
            let inner = members
                .iter()
                .enumerate()
                .filter(|(_, m)| !binary.nodes[**m].is_leaf());
            let Some((place, &largest)) = inner.max_by(|a, b| area(a.1).total_cmp(&area(b.1)))
            else {
                break;
            };
            let first = binary.nodes[largest].first_index as usize;
            members[place] = first;
            members.push(first + 1);
        }
        let number = self.nodes.len();
        // Boxes of missing children are never hit.
        let mut node = Node {
            low: [Vec4::INFINITY; 3],
            high: [Vec4::NEG_INFINITY; 3],
            children: [NONE; 4],
        };
        self.nodes.push(node);
        for (lane, &member) in members.iter().enumerate() {
            let source = &binary.nodes[member];
            for axis in 0..3 {
                node.low[axis][lane] = source.aabb().min[axis];
                node.high[axis][lane] = source.aabb().max[axis];
            }
            node.children[lane] = if source.is_leaf() {
                let slots =
                    source.first_index as usize..(source.first_index + source.prim_count) as usize;
                let numbers = binary.primitive_indices.get(slots).unwrap_or_default();
                self.leaves.push(Leaf::new(numbers, triangles));
                LEAF | (self.leaves.len() - 1) as u32
            } else {
                let first = source.first_index as usize;
                self.add(binary, triangles, &[first, first + 1], depth + 1)
            };
        }
        self.nodes[number] = node;
        number as u32
    }

    /// The first triangle on a ray beyond `nearest`.
    pub(super) fn first(&self, origin: Vec3A, direction: Vec3A, nearest: f32) -> Option<Crossing> {
        let ray = Ray::new(origin, direction);
        let mut best = None;
        self.walk(&ray, f32::INFINITY, |leaf, farthest| {
            let (distance, weights, mut hits) = leaf.cross(&ray, nearest, farthest);
            let mut farthest = farthest;
            while hits != 0 {
                let lane = hits.trailing_zeros() as usize;
                hits &= hits - 1;
                if distance[lane] < farthest {
                    farthest = distance[lane];
                    best = Some(Crossing {
                        distance: farthest,
                        triangle: leaf.triangles[lane],
                        weights: [weights[0][lane], weights[1][lane]],
                    });
                }
            }
            farthest
        });
        best
    }

    /// Whether any triangle that `counts` is on a ray up to `farthest`. If none counts, all were asked.
    pub(super) fn any(
        &self,
        origin: Vec3A,
        direction: Vec3A,
        farthest: f32,
        mut counts: impl FnMut(u32) -> bool,
    ) -> bool {
        let ray = Ray::new(origin, direction);
        let mut found = false;
        self.walk(&ray, farthest, |leaf, farthest| {
            let (_, _, mut hits) = leaf.cross(&ray, 0.0, farthest);
            while hits != 0 && !found {
                found = counts(leaf.triangles[hits.trailing_zeros() as usize]);
                hits &= hits - 1;
            }
            // Every box is further than a negative distance: the walk ends.
            if found { -1.0 } else { farthest }
        });
        found
    }

    /// Visits the leaves on a ray, near ones first; the answer of `visit` is where the ray ends.
    #[inline(always)]
    fn walk(&self, ray: &Ray, farthest: f32, visit: impl FnMut(&Leaf, f32) -> f32) {
        if 3 * self.depth < SHALLOW {
            self.walk_with(&mut [(0.0, 0); SHALLOW], ray, farthest, visit);
        } else {
            self.walk_with(
                &mut vec![(0.0, 0); 3 * self.depth + 1],
                ray,
                farthest,
                visit,
            );
        }
    }

    /// `open` has room for three children of every level: those that wait while the first is entered.
    #[inline(always)]
    fn walk_with(
        &self,
        open: &mut [(f32, u32)],
        ray: &Ray,
        mut farthest: f32,
        mut visit: impl FnMut(&Leaf, f32) -> f32,
    ) {
        let mut count = 0;
        let mut next = if self.nodes.is_empty() { NONE } else { 0 };
        loop {
            if next & LEAF == 0 {
                let node = &self.nodes[next as usize];
                let (distance, mut hits) = node.enter(ray, farthest);
                // Nearest first: the others wait, the farthest lowest on the stack.
                let start = count;
                while hits != 0 {
                    let lane = hits.trailing_zeros() as usize;
                    hits &= hits - 1;
                    let mut place = count;
                    let entry = (distance[lane], node.children[lane]);
                    while place > start && open[place - 1].0 < entry.0 {
                        open[place] = open[place - 1];
                        place -= 1;
                    }
                    open[place] = entry;
                    count += 1;
                }
            } else if next != NONE {
                farthest = visit(&self.leaves[(next ^ LEAF) as usize], farthest);
            }
            loop {
                if count == 0 {
                    return;
                }
                count -= 1;
                if open[count].0 <= farthest {
                    next = open[count].1;
                    break;
                }
            }
        }
    }
}

impl Node {
    /// Distances at which the ray enters the children's boxes, and a bit for each that it meets.
    #[inline(always)]
    fn enter(&self, ray: &Ray, farthest: f32) -> (Vec4, u32) {
        let (mut enter, mut leave) = (Vec4::ZERO, Vec4::splat(farthest));
        for axis in 0..3 {
            let a = (self.low[axis] - ray.origin[axis]) * ray.inverse[axis];
            let b = (self.high[axis] - ray.origin[axis]) * ray.inverse[axis];
            enter = enter.max(a.min(b));
            leave = leave.min(a.max(b) * BOX_SLACK);
        }
        (enter, enter.cmple(leave).bitmask())
    }
}

impl Leaf {
    fn new(numbers: &[u32], triangles: &[Triangle]) -> Self {
        // Lanes without a triangle have no area: their products are zero, and zero over zero hits nothing.
        let zero = [Vec4::ZERO; 3];
        let mut leaf = Self {
            corner: zero,
            edge1: zero,
            edge2: zero,
            slack: Vec4::ZERO,
            triangles: [NONE; 4],
        };
        for (lane, &number) in numbers.iter().take(4).enumerate() {
            let triangle = &triangles[number as usize];
            let (edge1, edge2) = (triangle.v1 - triangle.v0, triangle.v2 - triangle.v0);
            for axis in 0..3 {
                leaf.corner[axis][lane] = triangle.v0[axis];
                leaf.edge1[axis][lane] = edge1[axis];
                leaf.edge2[axis][lane] = edge2[axis];
            }
            let longest = edge1.length().max(edge2.length());
            let height = edge1.cross(edge2).length() / longest.max((edge2 - edge1).length());
            leaf.slack[lane] = (EDGE_SLACK / height).min(MOST_SLACK);
            leaf.triangles[lane] = number;
        }
        leaf
    }

    /// Distances, weights of the second and third vertices, and a bit for each triangle that the ray meets
    /// between two distances (Möller and Trumbore).
    #[inline(always)]
    fn cross(&self, ray: &Ray, nearest: f32, farthest: f32) -> (Vec4, [Vec4; 2], u32) {
        let across = cross(ray.direction, self.edge2);
        let inverse = dot(self.edge1, across).recip();
        let to_origin = [0, 1, 2].map(|axis| ray.origin[axis] - self.corner[axis]);
        let second = dot(to_origin, across) * inverse;
        let moment = cross(to_origin, self.edge1);
        let third = dot(ray.direction, moment) * inverse;
        let distance = dot(self.edge2, moment) * inverse;
        // Comparisons with NaN (a ray in the triangle's plane) are false: a miss.
        let hit = second.cmpge(-self.slack)
            & third.cmpge(-self.slack)
            & (second + third).cmple(1.0 + self.slack)
            & distance.cmpge(Vec4::splat(nearest))
            & distance.cmple(Vec4::splat(farthest));
        (distance, [second, third], hit.bitmask())
    }
}

#[inline(always)]
fn cross(a: [Vec4; 3], b: [Vec4; 3]) -> [Vec4; 3] {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

#[inline(always)]
fn dot(a: [Vec4; 3], b: [Vec4; 3]) -> Vec4 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}
