//! `bgdyn schema`: prints the JSON Schemas of the formats.

use anyhow::Result;
use clap::Args;

use crate::output::print;
use crate::schema;

/// Print the JSON Schema of mechanism files, or of scene files, for editors
#[derive(Args)]
#[command(
    after_help = "Example:\n  bgdyn schema > mechanism.schema.json\n  bgdyn schema --scene > scene.schema.json\nand in the first line of a spec:\n  # yaml-language-server: $schema=mechanism.schema.json"
)]
pub(crate) struct Schema {
    /// Print the schema of scene files
    #[arg(long)]
    scene: bool,
}

impl Schema {
    pub(crate) fn run(self) -> Result<()> {
        let schema = match self.scene {
            true => schema::scene(),
            false => schema::mechanism(),
        };
        print(&format!("{schema:#}\n"))
    }
}
