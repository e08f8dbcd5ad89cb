//! Shared by the tests of this crate.
#![allow(dead_code, reason = "every test uses a part")]

pub mod pairs;
