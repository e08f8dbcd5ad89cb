//! Oriented spheres, planes and points as vectors of the Lorentz space L(4,1), and canal surfaces as curves there
