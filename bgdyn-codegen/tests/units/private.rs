//! Files whose tests use private items. Those tests stand in the files themselves, and run here.
#![allow(dead_code, missing_docs)]

#[path = "../../src/legend.rs"]
mod legend;
#[path = "../../src/emit/order.rs"]
mod order;
#[path = "../../src/fault/suggest.rs"]
mod suggest;
