//! Rational Bézier and B-spline curves and patches whose control points may be points or vectors
