//! Certified real roots of Bernstein polynomials, refined variation-diminishing bounds, and curve intersections
