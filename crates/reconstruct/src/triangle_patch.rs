//! The triangular patch as a surface: three interpolants, blended.

use crate::coons::TransverseField;
use crate::hermite::hermite;
use crate::strip::{GeodesicStrip, Strip, StripSample};
use crate::triangle::{Triangle, TriangleTwists, Vertex};
use crate::{Curvatures, Surface, quadrature};
use bezier_mass::Partials;
use core::array::from_fn;
use glam::DVec3;

/// A triangular patch with geodesic boundaries, over barycentric coordinates `(l0, l1, l2)`; as a [`Surface`] over
/// `u = l1`, `v = l2`.
#[derive(Clone, Debug)]
pub struct TrianglePatch<S = GeodesicStrip> {
    pub(crate) triangle: Triangle<S>,
    pub(crate) twists: TriangleTwists,
    pub(crate) vectors: [DVec3; 3],
    pub(crate) fields: [TransverseField; 3],
}

/// A patch at a point: value, first and second derivatives by `l0, l1, l2` taken as independent.
pub(crate) struct BarycentricJet {
    pub(crate) value: DVec3,
    pub(crate) first: [DVec3; 3],
    pub(crate) second: [[DVec3; 3]; 3],
}

/// The two sides that an interpolant `P_i` uses, sampled where it uses them, with the Hermite functions there.
pub(crate) type SidePair = [(StripSample, [[f64; 4]; 3]); 2];

impl<S: Strip> TrianglePatch<S> {
    /// The boundary.
    #[must_use]
    pub fn triangle(&self) -> &Triangle<S> {
        &self.triangle
    }

    /// The free parameters it was made with.
    #[must_use]
    pub fn twists(&self) -> &TriangleTwists {
        &self.twists
    }

    /// The point with these barycentric coordinates.
    #[must_use]
    pub fn at(&self, l: [f64; 3]) -> DVec3 {
        self.jet(l, &self.samples(l)).value
    }

    /// The integral of the Gaussian curvature over the patch by quadrature with `n²` nodes. With a regular interior
    /// it agrees with [`Triangle::total_curvature`].
    #[must_use]
    pub fn integrated_curvature(&self, n: usize) -> f64 {
        let area = |l: [f64; 3]| {
            let at = self.partials(l[1], l[2]);
            Curvatures::of(&at).gaussian * at.du.cross(at.dv).length()
        };
        quadrature::triangle(n.max(1))
            .into_iter()
            .map(|(l, w)| w * area(l))
            .sum()
    }

    /// The largest geodesic curvature of the sides, relative to `1/length + curvature`, from `samples + 1` parameters
    /// on each.
    #[must_use]
    pub fn boundary_geodesic_curvature(&self, samples: usize) -> f64 {
        let n = samples.max(1);
        let mut worst: f64 = 0.0;
        for side in 0..3 {
            for i in 0..=n {
                let t = i as f64 / n as f64;
                let mut l = [0.0; 3];
                (l[(side + 1) % 3], l[(side + 2) % 3]) = (1.0 - t, t);
                let jet = self.jet(l, &self.samples(l));
                let (a, b) = ((side + 1) % 3, (side + 2) % 3);
                let velocity = jet.first[b] - jet.first[a];
                let acceleration = jet.second[b][b] - jet.second[a][b] * 2.0 + jet.second[a][a];
                let normal = (jet.first[1] - jet.first[0]).cross(jet.first[2] - jet.first[0]);
                let curvature = velocity.cross(acceleration).length() / velocity.length().powi(3);
                let bend = crate::geodesic_curvature(velocity, acceleration, normal).abs();
                let relative = bend / (1.0 / velocity.length() + curvature);
                worst = worst.max(if relative.is_finite() {
                    relative
                } else {
                    f64::INFINITY
                });
            }
        }
        worst
    }

    /// What one free parameter, larger by one, adds to the patch, which is affine in them.
    pub(crate) fn step(&self, parameter: usize) -> TwistStep {
        let vertex = parameter / 2;
        let direction = self.triangle.vertices[vertex].tangents[parameter % 2];
        let mut step = TwistStep {
            vectors: [DVec3::ZERO; 3],
            fields: [TransverseField::default(); 3],
        };
        step.vectors[vertex] = direction;
        for (side, end, sign) in [((vertex + 2) % 3, 0, 1.0), ((vertex + 1) % 3, 1, -1.0)] {
            let [p, q] = crate::coons::components(&self.triangle.ends[side][end], direction * sign);
            step.fields[side].along[1 + end] = p;
            step.fields[side].across[1 + end] = q;
        }
        step
    }

    pub(crate) fn samples(&self, l: [f64; 3]) -> [SidePair; 3] {
        from_fn(|i| {
            let (x, y) = (l[(i + 1) % 3], l[(i + 2) % 3]);
            [((i + 2) % 3, x), ((i + 1) % 3, 1.0 - y)]
                .map(|(side, t)| (self.triangle.strips[side].sample(t), hermite(t)))
        })
    }

    /// The interpolant of vertex `i`: value, by x, by y, by xx, xy, yy, with `x = l_(i+1)`, `y = l_(i+2)`:
    /// `A(x) + y D_A(x) + B(1-y) + x (D_B - B')(1-y) - (V + x d_a + y d_b + x y W)`.
    fn interpolant(&self, i: usize, [x, y]: [f64; 2], pair: &SidePair) -> [DVec3; 6] {
        let Vertex {
            point,
            sides: [da, db],
            ..
        } = self.triangle.vertices[i];
        let [(a, _), (b, _)] = pair;
        // What the sides alone contribute.
        let sides = [
            a.point[0] + b.point[0] - b.point[1] * x - (point + da * x + db * y),
            a.point[1] - b.point[1] - da,
            b.point[2] * x - b.point[1] - db,
            a.point[2],
            b.point[2],
            b.point[2] - b.point[3] * x,
        ];
        let across = transverse_part(&self.fields, &self.vectors, i, [x, y], pair);
        from_fn(|k| sides[k] + across[k])
    }

    pub(crate) fn jet(&self, l: [f64; 3], samples: &[SidePair; 3]) -> BarycentricJet {
        blended(l, |i, at| self.interpolant(i, at, &samples[i]))
    }
}

/// A change of a patch's twists and transverse fields.
pub(crate) struct TwistStep {
    vectors: [DVec3; 3],
    fields: [TransverseField; 3],
}

impl TwistStep {
    /// What it adds to the jet of the patch.
    pub(crate) fn jet(&self, l: [f64; 3], samples: &[SidePair; 3]) -> BarycentricJet {
        blended(l, |i, at| {
            transverse_part(&self.fields, &self.vectors, i, at, &samples[i])
        })
    }
}

/// The part `y D_A(x) + x D_B(1-y) - x y W` of an interpolant, linear in the fields and twists.
fn transverse_part(
    fields: &[TransverseField; 3],
    vectors: &[DVec3; 3],
    i: usize,
    [x, y]: [f64; 2],
    [(a, a_functions), (b, b_functions)]: &SidePair,
) -> [DVec3; 6] {
    let twist = vectors[i];
    let d_a = fields[(i + 2) % 3].at(a, a_functions);
    // D_B(1 - y): each derivative by y changes the sign.
    let [g, dg, ddg] = fields[(i + 1) % 3].at(b, b_functions);
    [
        d_a[0] * y + g * x - twist * (x * y),
        d_a[1] * y + g - twist * y,
        d_a[0] - dg * x - twist * x,
        d_a[2] * y,
        d_a[1] - dg - twist,
        ddg * x,
    ]
}

/// The three interpolants, blended.
fn blended(l: [f64; 3], interpolant: impl Fn(usize, [f64; 2]) -> [DVec3; 6]) -> BarycentricJet {
    let mut jet = BarycentricJet {
        value: DVec3::ZERO,
        first: [DVec3::ZERO; 3],
        second: [[DVec3::ZERO; 3]; 3],
    };
    for i in 0..3 {
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        let [p, px, py, pxx, pxy, pyy] = interpolant(i, [l[j], l[k]]);
        let mut first = [DVec3::ZERO; 3];
        (first[j], first[k]) = (px, py);
        let mut second = [[DVec3::ZERO; 3]; 3];
        (second[j][j], second[j][k], second[k][j], second[k][k]) = (pxx, pxy, pxy, pyy);
        let (a, da, dda) = blend(l, i);
        jet.value += p * a;
        for m in 0..3 {
            jet.first[m] += p * da[m] + first[m] * a;
            for n in 0..3 {
                jet.second[m][n] +=
                    p * dda[m][n] + first[m] * da[n] + first[n] * da[m] + second[m][n] * a;
            }
        }
    }
    jet
}

impl<S: Strip> Surface for TrianglePatch<S> {
    fn partials(&self, u: f64, v: f64) -> Partials<DVec3> {
        let l = [1.0 - u - v, u, v];
        let jet = self.jet(l, &self.samples(l));
        let second = |m: usize, n: usize| {
            jet.second[m][n] - jet.second[0][m] - jet.second[0][n] + jet.second[0][0]
        };
        Partials {
            position: jet.value,
            du: jet.first[1] - jet.first[0],
            dv: jet.first[2] - jet.first[0],
            duu: second(1, 1),
            duv: second(1, 2),
            dvv: second(2, 2),
        }
    }
}

/// `a_i = l_i² (3 - 2 l_i + 6 l_j l_k)` with its first and second derivatives.
fn blend(l: [f64; 3], i: usize) -> (f64, [f64; 3], [[f64; 3]; 3]) {
    let (j, k) = ((i + 1) % 3, (i + 2) % 3);
    let (x, y, z) = (l[i], l[j], l[k]);
    let mut first = [0.0; 3];
    (first[i], first[j], first[k]) = (
        6.0 * x - 6.0 * x * x + 12.0 * x * y * z,
        6.0 * x * x * z,
        6.0 * x * x * y,
    );
    let mut second = [[0.0; 3]; 3];
    second[i][i] = 6.0 - 12.0 * x + 12.0 * y * z;
    (second[i][j], second[j][i]) = (12.0 * x * z, 12.0 * x * z);
    (second[i][k], second[k][i]) = (12.0 * x * y, 12.0 * x * y);
    (second[j][k], second[k][j]) = (6.0 * x * x, 6.0 * x * x);
    (x * x * (3.0 - 2.0 * x + 6.0 * y * z), first, second)
}

#[cfg(test)]
mod tests {
    use super::blend;

    #[test]
    fn the_blend_is_a_partition_of_unity() {
        let l = [0.2, 0.5, 0.3];
        let total: f64 = (0..3).map(|i| blend(l, i).0).sum();
        assert!((total - 1.0).abs() < 1e-15);
        let h = 1e-6;
        for i in 0..3 {
            for m in 0..3 {
                let moved = |s: f64| {
                    let mut at = l;
                    at[m] += s;
                    blend(at, i)
                };
                let (before, after) = (moved(-h), moved(h));
                assert!(((after.0 - before.0) / (2.0 * h) - blend(l, i).1[m]).abs() < 1e-9);
                for n in 0..3 {
                    assert!(
                        ((after.1[n] - before.1[n]) / (2.0 * h) - blend(l, i).2[m][n]).abs() < 1e-9
                    );
                }
            }
        }
    }
}
