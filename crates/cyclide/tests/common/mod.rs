//! Shared by the tests of this crate.
#![allow(
    dead_code,
    unreachable_pub,
    reason = "every test uses a part, and so does xtask"
)]

pub mod pairs;
