//! The features of a plane conic: type, centre, axes, foci, vertices, directrices, asymptotes.

use glam::DVec2;

/// The conic that a plane quadratic is an arc of.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Conic {
    /// A circle.
    Circle(Circle),
    /// An ellipse that is not a circle.
    Ellipse(CentralConic),
    /// A parabola.
    Parabola(Parabola),
    /// A hyperbola.
    Hyperbola(CentralConic),
    /// Not a proper conic: the control mass points are linearly dependent.
    Degenerate(Degenerate),
}

/// A straight line of the plane, `normal . x = offset`.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Line {
    /// A unit normal.
    pub normal: DVec2,
    /// The signed distance of the line from the origin along the normal.
    pub offset: f64,
}

/// A circle.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Circle {
    /// The centre.
    pub centre: DVec2,
    /// The radius, positive.
    pub radius: f64,
}

/// A conic with a centre that is not a circle: an ellipse or a hyperbola.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct CentralConic {
    /// The centre.
    pub centre: DVec2,
    /// The unit direction of the axis through the foci, its first non-zero coordinate positive.
    pub major_direction: DVec2,
    /// The squares of the semi-axes along the major direction and across; the second is negative for a hyperbola.
    pub squared_semi_axes: [f64; 2],
}

/// A parabola.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Parabola {
    /// The focus.
    pub focus: DVec2,
    /// The directrix; its normal points to the focus, along the axis and into the parabola.
    pub directrix: Line,
}

/// What remains of a conic whose control mass points are linearly dependent.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Degenerate {
    /// All points of the curve are on one line.
    Line {
        /// A point of the line.
        point: DVec2,
        /// The unit direction of the line.
        direction: DVec2,
    },
    /// The curve is a single point.
    Point(DVec2),
    /// All control mass points are vectors: the curve is in the line at infinity.
    AtInfinity,
}

impl Line {
    /// The signed distance of a point, positive on the side of the normal.
    #[must_use]
    pub fn signed_distance(&self, point: DVec2) -> f64 {
        self.normal.dot(point) - self.offset
    }
}

impl CentralConic {
    /// The semi-axes: along the major direction and across. The slopes of a hyperbola's asymptotes in these axes are plus
    /// and minus the second over the first.
    #[must_use]
    pub fn semi_axes(&self) -> [f64; 2] {
        self.squared_semi_axes.map(|square| square.abs().sqrt())
    }

    /// The distance of a focus from the centre.
    #[must_use]
    pub fn focal_distance(&self) -> f64 {
        let [along, across] = self.squared_semi_axes;
        (along - across).max(0.0).sqrt()
    }

    /// The eccentricity: below one for an ellipse, above for a hyperbola.
    #[must_use]
    pub fn eccentricity(&self) -> f64 {
        self.focal_distance() / self.semi_axes()[0]
    }

    /// The two points on the major axis at the signed distances `-distance`, `distance` from the centre.
    fn on_major_axis(&self, distance: f64) -> [DVec2; 2] {
        [-distance, distance].map(|x| self.centre + self.major_direction * x)
    }

    /// The foci, the one against the major direction first.
    #[must_use]
    pub fn foci(&self) -> [DVec2; 2] {
        self.on_major_axis(self.focal_distance())
    }

    /// The vertices on the axis through the foci, the one against the major direction first.
    #[must_use]
    pub fn vertices(&self) -> [DVec2; 2] {
        self.on_major_axis(self.semi_axes()[0])
    }

    /// The ends of an ellipse's minor axis; `None` for a hyperbola, which does not meet that axis.
    #[must_use]
    pub fn co_vertices(&self) -> Option<[DVec2; 2]> {
        let across = self.major_direction.perp() * self.semi_axes()[1];
        (self.squared_semi_axes[1] > 0.0).then(|| [self.centre - across, self.centre + across])
    }

    /// The directrices, in the order of the foci that they belong to.
    #[must_use]
    pub fn directrices(&self) -> [Line; 2] {
        let distance = self.squared_semi_axes[0] / self.focal_distance();
        let middle = self.major_direction.dot(self.centre);
        [-distance, distance].map(|x| Line {
            normal: self.major_direction,
            offset: middle + x,
        })
    }

    /// The unit directions of a hyperbola's asymptotes, which pass through the centre; `None` for an ellipse.
    #[must_use]
    pub fn asymptotes(&self) -> Option<[DVec2; 2]> {
        let [along, across] = self.semi_axes();
        let (along, across) = (
            self.major_direction * along,
            self.major_direction.perp() * across,
        );
        (self.squared_semi_axes[1] < 0.0)
            .then(|| [(along - across).normalize(), (along + across).normalize()])
    }
}

impl Parabola {
    /// The unit direction of the axis, from the directrix to the focus.
    #[must_use]
    pub fn axis(&self) -> DVec2 {
        self.directrix.normal
    }

    /// The distance of the focus from the directrix.
    #[must_use]
    pub fn focal_parameter(&self) -> f64 {
        self.directrix.signed_distance(self.focus)
    }

    /// The vertex.
    #[must_use]
    pub fn vertex(&self) -> DVec2 {
        self.focus - self.axis() * (0.5 * self.focal_parameter())
    }
}

impl Conic {
    /// The eccentricity: 0 for a circle, 1 for a parabola; `None` if degenerate.
    #[must_use]
    pub fn eccentricity(&self) -> Option<f64> {
        match self {
            Self::Circle(_) => Some(0.0),
            Self::Parabola(_) => Some(1.0),
            Self::Ellipse(conic) | Self::Hyperbola(conic) => Some(conic.eccentricity()),
            Self::Degenerate(_) => None,
        }
    }

    /// The left side of the conic's equation in units of its own size: zero on the conic, negative on the side of the
    /// foci. `None` if degenerate.
    #[must_use]
    pub fn implicit(&self, point: DVec2) -> Option<f64> {
        match self {
            Self::Circle(Circle { centre, radius }) => {
                Some((point - *centre).length_squared() / (radius * radius) - 1.0)
            }
            Self::Ellipse(conic) | Self::Hyperbola(conic) => {
                let from_centre = point - conic.centre;
                let [x, y] = [
                    conic.major_direction.dot(from_centre),
                    conic.major_direction.perp_dot(from_centre),
                ];
                let [along, across] = conic.squared_semi_axes;
                let side = across.signum();
                Some(side * (x * x / along + y * y / across - 1.0))
            }
            Self::Parabola(parabola) => {
                let distance = parabola.directrix.signed_distance(point);
                let square = (point - parabola.focus).length_squared() - distance * distance;
                Some(square / parabola.focal_parameter().powi(2))
            }
            Self::Degenerate(_) => None,
        }
    }

    /// The conic scaled about the origin and then moved from there to `origin`.
    pub(crate) fn placed(self, origin: DVec2, scale: f64) -> Self {
        let place = |point: DVec2| origin + point * scale;
        match self {
            Self::Circle(Circle { centre, radius }) => Self::Circle(Circle {
                centre: place(centre),
                radius: radius * scale,
            }),
            Self::Ellipse(conic) => Self::Ellipse(conic.placed(origin, scale)),
            Self::Hyperbola(conic) => Self::Hyperbola(conic.placed(origin, scale)),
            Self::Parabola(Parabola {
                focus,
                directrix: Line { normal, offset },
            }) => Self::Parabola(Parabola {
                focus: place(focus),
                directrix: Line {
                    normal,
                    offset: offset * scale + normal.dot(origin),
                },
            }),
            Self::Degenerate(Degenerate::Line { point, direction }) => {
                Self::Degenerate(Degenerate::Line {
                    point: place(point),
                    direction,
                })
            }
            Self::Degenerate(Degenerate::Point(point)) => {
                Self::Degenerate(Degenerate::Point(place(point)))
            }
            Self::Degenerate(Degenerate::AtInfinity) => self,
        }
    }
}

impl CentralConic {
    pub(crate) fn placed(self, origin: DVec2, scale: f64) -> Self {
        Self {
            centre: origin + self.centre * scale,
            squared_semi_axes: self.squared_semi_axes.map(|square| square * scale * scale),
            ..self
        }
    }
}
