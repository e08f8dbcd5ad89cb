//! Demos, gallery and benchmarks of the workspace: everything that knows a file, a pixel or a colour.
//!
//! ```text
//!   demos/NAME.rs ──> demo::Context ──> figure ──> PNG, SVG
//!        │                  │      ──> render ──> EXR, PNG      gallery: every demo, one index.html
//!        └─ numbers ────────┤      ──> export ──> OBJ, glTF, STEP
//!                           └────────> report.json
//! ```
//!
//! - [`demo`]: how a demo is declared, run and reported; [`demos`] is the list of them.
//! - [`figure`]: plane drawings, one drawing model for PNG and SVG.
//! - [`mesh`] and [`render`]: tessellations and a small ray tracer.
//! - [`export`]: files that other programs open.
//! - [`bench`](mod@bench): timed work, with peers where they can be linked in.
//!
//! Data flows one way: a demo computes with the crates, hands drawings and numbers to its
//! [`demo::Context`], and nothing here is read back by the crates.

pub mod bench;
pub mod color;
pub mod demo;
pub mod demos;
pub mod export;
pub mod figure;
pub mod gallery;
pub mod image;
pub mod mesh;
pub mod random;
pub mod render;
pub mod report;
