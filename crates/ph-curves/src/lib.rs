//! Planar curves whose offsets are exact.
#![cfg_attr(docsrs, feature(doc_cfg))]

mod class3;
mod complex;
mod dual;
mod error;
mod line;
mod ph_arc;
mod t_cubic;

pub use class3::{G1Ends, LineElement};
pub use dual::DualCurve;
pub use error::Error;
pub use glam;
pub use line::Line;
pub use ph_arc::{Contact, PhArc, TQuartic};
pub use t_cubic::TCubic;
