use std::f64::consts::TAU;

use glam::DVec3;

use crate::canal::Ring;
use crate::circle::frame_about;
use crate::{CanalCurve, Error};

/// How to lay a grid on a canal surface: rings along the curve, vertices around each ring.
///
/// ```
/// use lorentz::{Spacing, TubeGrid};
/// let grid = TubeGrid::new(100, 48).with_spacing(Spacing::Parameter).with_interval(0.25, 0.75);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct TubeGrid {
    /// Steps along the curve; there is one ring more.
    pub steps: usize,
    /// Vertices of a ring, at equal angles from the reference direction.
    pub sectors: usize,
    /// Where the rings stand.
    pub spacing: Spacing,
    /// First and last parameter.
    pub interval: [f64; 2],
    /// Direction of angle zero; `None` takes [`CanalCurve::reference`].
    pub reference: Option<DVec3>,
}

/// Where the rings of a tessellation stand.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Spacing {
    /// At equal steps of the parameter: the cheapest. Arcs with end weights 1 and a middle weight near 1 are even enough.
    Parameter,
    /// At nearly equal distances on the surface, measured where neighbouring rings are farthest apart. Arcs that end in
    /// a singular point need it: their parameter is very uneven.
    #[default]
    ArcLength,
}

/// The vertices of a canal surface on a grid, ring by ring, with unit normals.
///
/// Vertex `i * sectors + j` is the one of angle `2 pi j / sectors` on ring `i`. Keep one and refill it by
/// [`CanalCurve::tessellate_into`]: then nothing is allocated.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Tube {
    sectors: usize,
    parameters: Vec<f64>,
    positions: Vec<DVec3>,
    normals: Vec<DVec3>,
    /// Cosine and sine of the angles of a ring, kept between refills.
    directions: Vec<[f64; 2]>,
    frames: Vec<RingFrame>,
}

/// A ring with its frame multiplied out, so that a vertex costs four multiplications and additions per coordinate.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
struct RingFrame {
    centre: DVec3,
    /// Radius times the two directions of the frame.
    arms: [DVec3; 2],
    /// The part of the normal along the axis.
    normal_centre: DVec3,
    /// The outward part of the normal times the two directions of the frame.
    normal_arms: [DVec3; 2],
    /// Whether the normals point away from the axis.
    outward: bool,
}

impl TubeGrid {
    /// A grid of `steps` by `sectors` over the whole curve, spaced by arc length.
    #[must_use]
    pub const fn new(steps: usize, sectors: usize) -> Self {
        Self {
            steps,
            sectors,
            spacing: Spacing::ArcLength,
            interval: [0.0, 1.0],
            reference: None,
        }
    }

    /// The same grid with another spacing of the rings.
    #[must_use]
    pub const fn with_spacing(self, spacing: Spacing) -> Self {
        Self { spacing, ..self }
    }

    /// The same grid over a part of the curve.
    #[must_use]
    pub const fn with_interval(self, start: f64, end: f64) -> Self {
        Self {
            interval: [start, end],
            ..self
        }
    }

    /// The same grid with another direction of angle zero.
    #[must_use]
    pub const fn with_reference(self, reference: DVec3) -> Self {
        Self {
            reference: Some(reference),
            ..self
        }
    }

    fn check(&self) -> Result<(), Error> {
        let Self {
            steps,
            sectors,
            interval,
            ..
        } = *self;
        let vertices = steps
            .checked_add(1)
            .and_then(|rings| rings.checked_mul(sectors));
        if steps < 1 || sectors < 3 || vertices.is_none_or(|count| count > u32::MAX as usize) {
            return Err(Error::GridSize { steps, sectors });
        }
        if interval.iter().all(|t| t.is_finite()) {
            Ok(())
        } else {
            Err(Error::NonFinite {
                what: "a grid's interval",
            })
        }
    }
}

impl CanalCurve {
    /// Positions and unit normals of the surface on a grid, on the envelope to rounding.
    ///
    /// No trigonometry and no square root per vertex: time grows with the number of vertices, at the speed of memory.
    /// Rings at a finite vertex of the surface shrink to a point and carry the limits of the normals.
    ///
    /// ```
    /// use lorentz::{Sphere, TubeGrid, construct, glam::dvec3};
    /// let patch = construct::cone_between_radii(
    ///     dvec3(0.0, 0.0, 0.0), Sphere::new(dvec3(0.0, 0.0, 5.0), 3.0)?, [1.0, 2.0])?;
    /// let tube = patch.curve.tessellate(&TubeGrid::new(10, 32))?;
    /// assert_eq!(tube.positions().len(), 11 * 32);
    /// assert_eq!(tube.triangles().len(), 2 * 10 * 32);
    /// # Ok::<(), lorentz::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::GridSize`]; [`Error::NonFinite`]; [`Error::ReferenceParallelToAxis`]; [`Error::SingularPoint`] at a vertex at
    /// infinity and [`Error::CharacteristicLine`] at a line, which have no vertices of a mesh.
    pub fn tessellate(&self, grid: &TubeGrid) -> Result<Tube, Error> {
        let mut tube = Tube::default();
        self.tessellate_into(grid, &mut tube)?;
        Ok(tube)
    }

    /// As [`tessellate`](Self::tessellate), into a tube that is refilled. After an error it is empty.
    ///
    /// # Errors
    /// Those of [`tessellate`](Self::tessellate).
    pub fn tessellate_into(&self, grid: &TubeGrid, tube: &mut Tube) -> Result<(), Error> {
        self.prepare(grid, tube)?;
        let rings = tube
            .positions
            .chunks_exact_mut(grid.sectors)
            .zip(tube.normals.chunks_exact_mut(grid.sectors));
        for (frame, (positions, normals)) in tube.frames.iter().zip(rings) {
            frame.fill(&tube.directions, positions, normals);
        }
        Ok(())
    }

    /// As [`tessellate_into`](Self::tessellate_into), the rings shared among all cores.
    ///
    /// # Errors
    /// Those of [`tessellate`](Self::tessellate).
    #[cfg(feature = "rayon")]
    pub fn tessellate_parallel(&self, grid: &TubeGrid, tube: &mut Tube) -> Result<(), Error> {
        use rayon::prelude::*;
        self.prepare(grid, tube)?;
        let Tube {
            positions,
            normals,
            directions,
            frames,
            ..
        } = tube;
        let rings = positions
            .par_chunks_exact_mut(grid.sectors)
            .zip(normals.par_chunks_exact_mut(grid.sectors));
        frames
            .par_iter()
            .zip(rings)
            .for_each(|(frame, (positions, normals))| frame.fill(directions, positions, normals));
        Ok(())
    }

    /// Everything but the vertices.
    fn prepare(&self, grid: &TubeGrid, tube: &mut Tube) -> Result<(), Error> {
        tube.clear();
        grid.check()?;
        let reference = grid.reference.unwrap_or_else(|| self.reference());
        tube.set_sectors(grid.sectors);
        let [start, end] = grid.interval;
        let even = |i: usize| start + (end - start) * (i as f64 / grid.steps as f64);
        tube.parameters.extend((0..=grid.steps).map(even));
        tube.parameters[grid.steps] = end;
        tube.frames.reserve(grid.steps + 1);
        self.frames(reference, tube)?;
        if grid.spacing == Spacing::ArcLength {
            for _ in 0..EVENING_ROUNDS {
                tube.even_parameters();
                self.frames(reference, tube)?;
            }
        }
        let count = (grid.steps + 1) * grid.sectors;
        tube.positions.resize(count, DVec3::ZERO);
        tube.normals.resize(count, DVec3::ZERO);
        Ok(())
    }

    /// The ring frames at the tube's parameters; on an error the tube is emptied.
    fn frames(&self, reference: DVec3, tube: &mut Tube) -> Result<(), Error> {
        tube.frames.clear();
        let mut sign = 0.0_f64;
        for &t in &tube.parameters {
            let member = self.at(t);
            if member.weight() != 0.0 {
                sign = member.weight().signum();
            } else if sign == 0.0 {
                // At a vertex at the start: the sign that the weight is about to have.
                sign = self.weight_sign_after(t, tube.parameters.last().copied().unwrap_or(1.0));
            }
            let framed = member
                .ring_with_sign(sign)
                .ok_or(if member.weight() == 0.0 {
                    Error::SingularPoint { t }
                } else {
                    Error::CharacteristicLine { t }
                })
                .and_then(|ring| RingFrame::new(&ring, reference));
            match framed {
                Ok(frame) => tube.frames.push(frame),
                Err(error) => {
                    tube.clear();
                    return Err(error);
                }
            }
        }
        Ok(())
    }

    /// The sign of the weight a little beyond `t`, on the way to `end`.
    fn weight_sign_after(&self, t: f64, end: f64) -> f64 {
        // A quadratic weight has no further zero that near, unless it vanishes twice.
        let weight = self.at(t + 1e-6 * (end - t)).weight();
        if weight < 0.0 { -1.0 } else { 1.0 }
    }
}

/// How often the rings are moved to equal distances. Each round interpolates linearly between the rings of the last;
/// four leave steps within a few percent on the arcs of the paper's seahorse, whose tail has a middle weight of 0.02.
const EVENING_ROUNDS: usize = 4;

impl RingFrame {
    fn new(ring: &Ring, reference: DVec3) -> Result<Self, Error> {
        let (u, v) = frame_about(ring.axis, reference)?;
        Ok(Self {
            centre: ring.centre,
            arms: [ring.radius * u, ring.radius * v],
            normal_centre: ring.normal_along_axis * ring.axis,
            normal_arms: [ring.normal_outward * u, ring.normal_outward * v],
            outward: ring.normal_outward >= 0.0,
        })
    }

    /// The vertices of the ring.
    fn fill(&self, directions: &[[f64; 2]], positions: &mut [DVec3], normals: &mut [DVec3]) {
        for ((&[cos, sin], position), normal) in directions.iter().zip(positions).zip(normals) {
            *position = self.centre + cos * self.arms[0] + sin * self.arms[1];
            *normal = self.normal_centre + cos * self.normal_arms[0] + sin * self.normal_arms[1];
        }
    }

    /// The distance to another ring, where it is greatest among four points.
    fn distance(&self, other: &Self) -> f64 {
        let step = other.centre - self.centre;
        let (u, v) = (other.arms[0] - self.arms[0], other.arms[1] - self.arms[1]);
        [step + u, step - u, step + v, step - v]
            .iter()
            .fold(0.0_f64, |most, d| most.max(d.length_squared()))
            .sqrt()
    }
}

impl Tube {
    /// Number of vertices of a ring.
    #[must_use]
    pub const fn sectors(&self) -> usize {
        self.sectors
    }

    /// Parameters of the rings.
    #[must_use]
    pub fn parameters(&self) -> &[f64] {
        &self.parameters
    }

    /// Positions of the vertices, ring by ring.
    #[must_use]
    pub fn positions(&self) -> &[DVec3] {
        &self.positions
    }

    /// Unit normals of the surface at the vertices.
    #[must_use]
    pub fn normals(&self) -> &[DVec3] {
        &self.normals
    }

    /// The vertices of ring `i`, if there is one.
    #[must_use]
    pub fn ring(&self, i: usize) -> Option<&[DVec3]> {
        self.positions.chunks_exact(self.sectors.max(1)).nth(i)
    }

    /// Triangles as triples of vertex numbers, counter-clockwise seen from the side of the normals; the thin halves at
    /// rings that have shrunk to a point are left out.
    #[must_use]
    pub fn triangles(&self) -> Vec<[u32; 3]> {
        let sectors = self.sectors as u32;
        let mut triangles = Vec::with_capacity(2 * self.positions.len());
        for (i, (near, far)) in self
            .frames
            .iter()
            .zip(self.frames.iter().skip(1))
            .enumerate()
        {
            let (a, b) = (i as u32 * sectors, (i as u32 + 1) * sectors);
            let is_point = |frame: &RingFrame| frame.arms[0] == DVec3::ZERO;
            // A ring that is a point has no side of its own.
            let outward = if is_point(near) {
                far.outward
            } else {
                near.outward
            };
            for j in 0..sectors {
                let next = (j + 1) % sectors;
                let mut push = |[p, q, r]: [u32; 3]| {
                    triangles.push(if outward { [p, q, r] } else { [p, r, q] })
                };
                if !is_point(near) {
                    push([a + j, a + next, b + j]);
                }
                if !is_point(far) {
                    push([a + next, b + next, b + j]);
                }
            }
        }
        triangles
    }

    fn clear(&mut self) {
        self.parameters.clear();
        self.positions.clear();
        self.normals.clear();
        self.frames.clear();
    }

    fn set_sectors(&mut self, sectors: usize) {
        if self.directions.len() == sectors {
            return;
        }
        self.sectors = sectors;
        let direction = |j: usize| {
            let (sin, cos) = (TAU * (j as f64 / sectors as f64)).sin_cos();
            [cos, sin]
        };
        self.directions.clear();
        self.directions.extend((0..sectors).map(direction));
    }

    /// Moves the parameters so that the rings, as they stood, would be equally far apart.
    fn even_parameters(&mut self) {
        let steps: Vec<f64> = self
            .frames
            .iter()
            .zip(self.frames.iter().skip(1))
            .map(|(a, b)| a.distance(b))
            .collect();
        let total: f64 = steps.iter().sum();
        if !(total > 0.0 && total.is_finite()) {
            return;
        }
        let old = self.parameters.clone();
        let (mut interval, mut passed) = (0, 0.0);
        let count = steps.len();
        for (i, parameter) in self.parameters.iter_mut().enumerate().take(count).skip(1) {
            let wanted = total * (i as f64 / count as f64);
            while interval + 1 < count && passed + steps[interval] < wanted {
                passed += steps[interval];
                interval += 1;
            }
            let part = ((wanted - passed) / steps[interval].max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
            *parameter = old[interval] + part * (old[interval + 1] - old[interval]);
        }
    }
}
