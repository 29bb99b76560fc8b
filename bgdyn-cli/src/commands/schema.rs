//! `bgdyn schema`: what editors need to help with a spec.

use anyhow::Result;
use clap::Args;

use crate::output::print;
use crate::schema;

/// The JSON Schema of a mechanism's file, for editors
#[derive(Args)]
#[command(
    after_help = "Example:\n  bgdyn schema > mechanism.schema.json\nand in the first line of a spec:\n  # yaml-language-server: $schema=mechanism.schema.json"
)]
pub(crate) struct Schema {}

impl Schema {
    pub(crate) fn run(self) -> Result<()> {
        print(&format!("{:#}\n", schema::mechanism()))
    }
}
