//! What is known while a block is written.

use proc_macro2::{Ident, TokenStream};

use super::code::Spelling;
use crate::plan::Listing;

/// The arrays that a column reads.
pub(super) struct ColumnArrays {
    /// Values that all columns share.
    pub(super) shared: Ident,
    /// Values of each column, row by row.
    pub(super) own: Ident,
}

/// A result that is written entry by entry.
pub(super) struct StoredResult<'a> {
    /// Builds the whole result from the block's outputs.
    pub(super) whole: &'a dyn Fn(&[TokenStream]) -> TokenStream,
    /// The matrices of the result.
    pub(super) matrices: Matrices,
}

/// The matrices of a result.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Matrices {
    /// One, if any.
    One,
    /// A list.
    List,
    /// Several lists.
    Lists,
}

/// A block, and how it is written.
pub(super) struct Writer<'a> {
    pub(super) listing: &'a Listing<'a>,
    pub(super) spelling: &'a Spelling<'a>,
    /// Whether the block is a function of its own.
    pub(super) separate: bool,
    /// The arrays that a column of a loop reads.
    pub(super) arrays: Option<ColumnArrays>,
    /// The result, if it is written entry by entry.
    pub(super) target: Option<StoredResult<'a>>,
}

impl<'a> Writer<'a> {
    pub(super) fn new(listing: &'a Listing<'a>, spelling: &'a Spelling<'a>) -> Self {
        Writer {
            listing,
            spelling,
            separate: false,
            arrays: None,
            target: None,
        }
    }
}
