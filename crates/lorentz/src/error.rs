use glam::DVec3;

/// Why a request about spheres had no answer. Every variant carries the numbers that explain it.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// A NaN, an infinity, or a number so large that its square is one.
    #[error("{what} is not a finite number, or too large to be squared")]
    NonFinite {
        /// The argument that was refused.
        what: &'static str,
    },
    /// A sphere of radius zero: that is a point, see [`Point`](crate::Point).
    #[error("the sphere about {centre} has zero radius: it is a point")]
    ZeroRadius {
        /// Centre of the refused sphere.
        centre: DVec3,
    },
    /// A plane or a circle was given a zero vector as its normal.
    #[error("a zero normal gives no direction")]
    ZeroNormal,
    /// The vector is zero and represents nothing.
    #[error("the zero vector represents no object")]
    ZeroVector,
    /// The vector is time-like: it would be a sphere of imaginary radius.
    #[error("the time-like vector of square {square} is a sphere of imaginary radius")]
    TimeLike {
        /// Lorentz square of the vector, negative.
        square: f64,
    },
    /// The vector is light-like where a sphere or a plane was asked for.
    #[error("the light-like vector of square {square} is a point, not a sphere")]
    LightLike {
        /// Lorentz square of the vector.
        square: f64,
    },
    /// Two equal spheres span no pencil.
    #[error("the two spheres are the same up to orientation (product {product})")]
    SameSphere {
        /// Lorentz product of the two, 1 or -1.
        product: f64,
    },
    /// A circle is carried by two orthogonal spheres, and these are not.
    #[error("the spheres are not orthogonal: their product is {product}")]
    NotOrthogonal {
        /// Lorentz product of the two unit vectors, the cosine of their angle.
        product: f64,
    },
    /// Six-vectors off the Lie quadric: the Bézier curve leaves the space of spheres.
    #[error("the Bézier curve leaves the space of spheres: relative residual {residual}")]
    OffTheQuadric {
        /// Largest residual of the five conditions, relative to the terms that were added.
        residual: f64,
    },
    /// The spheres of the curve are nested: they have no envelope.
    #[error("the tangent of the curve of spheres is not space-like: K = {k}, there is no envelope")]
    NotSpaceLike {
        /// The invariant K of the curve, zero or negative.
        k: f64,
    },
    /// The circle has shrunk to a point: no direction is defined there.
    #[error("the characteristic circle at t = {t} is a singular point")]
    SingularPoint {
        /// Parameter of the curve.
        t: f64,
    },
    /// The characteristic circle is a line: an angle does not tell a point of it.
    #[error("the characteristic circle at t = {t} is a line")]
    CharacteristicLine {
        /// Parameter of the curve.
        t: f64,
    },
    /// The reference direction of the angle is parallel to the circle's axis.
    #[error("the reference direction is parallel to the axis {axis} of the circle")]
    ReferenceParallelToAxis {
        /// Axis of the characteristic circle.
        axis: DVec3,
    },
    /// The two end points are one point.
    #[error("the two points coincide")]
    CoincidentPoints,
    /// One of the two end points lies on the sphere between them.
    #[error(
        "a point lies on the sphere: the products with the two points are {first} and {second}"
    )]
    PointOnSphere {
        /// Product of the sphere with the first point.
        first: f64,
        /// Product of the sphere with the second point.
        second: f64,
    },
    /// One end point is inside and one outside of the sphere.
    #[error("the sphere separates the two points: the products are {first} and {second}")]
    SphereSeparatesPoints {
        /// Product of the sphere with the first point.
        first: f64,
        /// Product of the sphere with the second point.
        second: f64,
    },
    /// The end point lies on the sphere from which the arc should leave.
    #[error("the point lies on the first sphere (product {product})")]
    PointOnFirstSphere {
        /// Product of sphere and point.
        product: f64,
    },
    /// The arc should end in the sphere from which it leaves.
    #[error("the second sphere equals the first up to orientation (product {product})")]
    SecondEqualsFirst {
        /// Lorentz product of the two, 1 or -1.
        product: f64,
    },
    /// The two spheres touch with the same orientation: only a line of the space of spheres joins them.
    #[error("the two spheres are tangent with the same orientation")]
    TangentSameOrientation,
    /// Spheres of this sign of the radius lie on the other nappe.
    #[error("radius {radius} must have the sign of the weight {weight}")]
    WrongSign {
        /// Radius that was asked for.
        radius: f64,
        /// Middle weight of the cone's curve.
        weight: f64,
    },
    /// The arcs meet in a point, where there is no circle to compare.
    #[error("the joint is at a singular point")]
    SingularJoint,
    /// The plane section of a cone by a plane through its vertex consists of lines.
    #[error("the plane passes through the vertex of the cone (distance {distance})")]
    PlaneThroughVertex {
        /// Signed distance of the vertex from the plane.
        distance: f64,
    },
    /// What the Bézier arithmetic refused: a parameter interval without extent, a number that is not finite.
    #[error(transparent)]
    Bezier(#[from] bezier_mass::Error),
    /// The second curve is not a curve of the second family of the first.
    #[error("the two curves are not the two families of one cyclide: relative residual {residual}")]
    NotTheSecondFamily {
        /// Largest Lie product of a control of one with a control of the other, relative to its terms.
        residual: f64,
    },
    /// The matrix does not preserve the Lorentz product.
    #[error("the matrix does not preserve the Lorentz product: relative residual {residual}")]
    NotALorentzMap {
        /// Largest error of a product of two columns, relative.
        residual: f64,
    },
    /// A scale factor that is not positive.
    #[error("the scale factor {factor} must be positive")]
    ScaleNotPositive {
        /// The refused factor.
        factor: f64,
    },
    /// The three control vectors do not span a plane of spheres.
    #[error("the three controls are linearly dependent: there is no second family")]
    DegenerateControls,
    /// A grid needs at least one step along the curve and three around it.
    #[error(
        "a grid of {steps} steps and {sectors} sectors is too small (1 and 3 at least) or too large to address"
    )]
    GridSize {
        /// Steps along the curve.
        steps: usize,
        /// Steps around the circle.
        sectors: usize,
    },
    /// A chain without an arc.
    #[error("a chain needs at least one arc")]
    EmptyChain,
    /// A circle whose radius is not positive.
    #[error("the radius {radius} of a circle must be positive")]
    CircleRadius {
        /// The refused radius.
        radius: f64,
    },
}
