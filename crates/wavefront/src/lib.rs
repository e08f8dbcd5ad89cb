//! Wavefronts in dual Bézier form: propagation, reflection, transmission, caustics and anisotropy
