//! Ovals, cams, Minkowski offsets, spatial curves and PH quintics.

use integration_tests::Case;

/// Kinds whose answers are still being written.
pub(crate) const PENDING: &[&str] = &[
    "ph_quintic_hermite",
    "ph_quintic_offset",
    "ph_quintic_spline",
    "cam_from_lift",
    "class5_hermite",
    "constant_width_from_polygon",
    "general_offset",
    "ih_offset_lines",
    "isoperimetrix_point",
    "minkowski_norm",
    "quaternion_sqrt",
    "rmf_numeric",
    "rrmf",
    "spatial_ph_hermite",
];

/// Answers the case if its kind is one of this file.
pub(crate) fn answer(_case: &Case<'_>) -> bool {
    false
}
