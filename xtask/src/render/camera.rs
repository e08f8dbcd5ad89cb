//! Where the picture is taken from.

use glam::DVec3;

/// A pinhole camera. The world's up is z.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    eye: DVec3,
    /// Right, up, forward: orthonormal.
    axes: [DVec3; 3],
    /// Half the picture's height at distance one.
    half_height: f64,
    /// The picture's width over its height.
    aspect: f64,
}

/// Vertical angle of view unless another is asked for: that of a portrait lens, which does not distort.
const FIELD_OF_VIEW: f64 = 0.46;
/// Free border around a fitted model, as part of the picture.
const BORDER: f64 = 0.06;

impl Camera {
    /// A camera at `eye` that looks at `target`, for pictures of width over height `aspect`.
    #[must_use]
    pub fn look_at(eye: DVec3, target: DVec3, aspect: f64) -> Self {
        let forward = (target - eye).normalize_or(DVec3::Y);
        let right = forward.cross(DVec3::Z).try_normalize().unwrap_or(DVec3::X);
        Self {
            eye,
            axes: [right, right.cross(forward), forward],
            half_height: (0.5 * FIELD_OF_VIEW).tan(),
            aspect: aspect.clamp(0.01, 100.0),
        }
    }

    /// The same with another vertical angle of view, in radians.
    #[must_use]
    pub fn field_of_view(self, angle: f64) -> Self {
        Self {
            half_height: (0.5 * angle.clamp(1e-3, 3.0)).tan(),
            ..self
        }
    }

    /// A camera in the direction `towards_eye` from `points`, so far away that all of them are in a
    /// picture of width over height `aspect`, with a small border.
    #[must_use]
    pub fn fit(points: &[DVec3], towards_eye: DVec3, aspect: f64) -> Self {
        let towards_eye = towards_eye.normalize_or(DVec3::new(0.5, -1.0, 0.5).normalize());
        let camera = Self::look_at(towards_eye, DVec3::ZERO, aspect);
        let [right, up, _] = camera.axes;
        let room = camera.half_height * (1.0 - 2.0 * BORDER);
        // Each point asks, in each of four directions, for the eye to be behind a plane through it:
        // x <= (d - z) room, and so on. The two tightest of a pair fix the shift and the distance.
        let needs = |side: DVec3, room: f64| {
            points
                .iter()
                .map(|p| (p.dot(side) + p.dot(towards_eye) * room) / room)
                .fold(f64::NEG_INFINITY, f64::max)
        };
        let wide = room * camera.aspect;
        let (r, l, t, b) = (
            needs(right, wide),
            needs(-right, wide),
            needs(up, room),
            needs(-up, room),
        );
        let distance = (0.5 * (r + l)).max(0.5 * (t + b));
        if !distance.is_finite() {
            return camera;
        }
        // Where one direction has room to spare, the model stands in its middle.
        let shift = right * (0.5 * (r - l) * wide) + up * (0.5 * (t - b) * room);
        Self {
            eye: shift + towards_eye * distance,
            ..camera
        }
    }

    /// The eye.
    #[must_use]
    pub const fn eye(&self) -> DVec3 {
        self.eye
    }

    /// Right, up and forward, orthonormal.
    #[must_use]
    pub const fn axes(&self) -> [DVec3; 3] {
        self.axes
    }

    /// Half the picture's height at distance one.
    #[must_use]
    pub const fn half_height(&self) -> f64 {
        self.half_height
    }

    /// Width over height of the picture.
    #[must_use]
    pub const fn aspect(&self) -> f64 {
        self.aspect
    }

    /// Where a point is in a picture of this size (pixels from the top left corner), and its distance
    /// along the line of sight.
    #[must_use]
    pub fn project(&self, point: DVec3, width: u32, height: u32) -> DVec3 {
        let [right, up, forward] = self.axes;
        let offset = point - self.eye;
        let depth = offset.dot(forward);
        let scale = 0.5 * f64::from(height) / (self.half_height * depth);
        DVec3::new(
            0.5 * f64::from(width) + offset.dot(right) * scale,
            0.5 * f64::from(height) - offset.dot(up) * scale,
            depth,
        )
    }

    /// The size of a pixel at `point`, in world units, in a picture of `height` rows.
    #[must_use]
    pub fn pixel_size(&self, point: DVec3, height: u32) -> f64 {
        let [.., forward] = self.axes;
        let depth = (point - self.eye).dot(forward).abs();
        2.0 * self.half_height * depth / f64::from(height.max(1))
    }

    /// The chord error that cannot be seen at `point`: half a pixel.
    #[must_use]
    pub fn tolerance(&self, point: DVec3, height: u32) -> f64 {
        0.5 * self.pixel_size(point, height)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_fitted_model_fills_the_picture_but_for_the_border() {
        let points: Vec<DVec3> = (0..8)
            .map(|i| {
                DVec3::new(
                    f64::from(i & 1) * 3.0,
                    f64::from(i >> 1 & 1),
                    f64::from(i >> 2),
                )
            })
            .collect();
        let camera = Camera::fit(&points, DVec3::new(1.0, -2.0, 0.7), 4.0 / 3.0);
        let pixels: Vec<DVec3> = points
            .iter()
            .map(|&p| camera.project(p, 400, 300))
            .collect();
        let low = pixels.iter().copied().reduce(DVec3::min).unwrap();
        let high = pixels.iter().copied().reduce(DVec3::max).unwrap();
        assert!(
            low.x > 23.9 && low.y > 17.9 && high.x < 376.1 && high.y < 282.1,
            "{low} {high}"
        );
        // One direction is tight on both sides; the other is in the middle but for perspective.
        let tight = high.x - low.x > 351.999 || high.y - low.y > 263.999;
        assert!(tight, "{low} {high}");
        assert!(
            (low.x + high.x - 400.0).abs() < 20.0 && (low.y + high.y - 300.0).abs() < 20.0,
            "{low} {high}"
        );
    }

    #[test]
    fn a_step_of_one_pixel_size_is_one_pixel() {
        let camera = Camera::look_at(DVec3::new(1.0, -5.0, 2.0), DVec3::ZERO, 4.0 / 3.0);
        let p = DVec3::new(0.3, 0.2, -0.1);
        let step = camera.axes()[0] * camera.pixel_size(p, 300);
        let moved = camera.project(p + step, 400, 300) - camera.project(p, 400, 300);
        assert!((moved.x - 1.0).abs() < 1e-9 && moved.y.abs() < 1e-9);
    }
}
