//! Dupin cyclides of every type, their exact rational patches, and the blending of cones
