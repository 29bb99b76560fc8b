//! `bgdyn import` on the command line: arguments, files, messages.

use super::{Base, Convention, Lock, Options, import_table, import_with, naming};
use crate::output::{print, tell};
use crate::quantity::value;
use crate::spec_file::{STDIN_NAME, is_stdin, read_text, shown};
use anyhow::{Context, Result, anyhow};
use bgdyn_codegen::format::Dimension;
use std::path::{Path, PathBuf};

/// Convert a URDF, an MJCF, an SDF or a table of Denavit–Hartenberg parameters to a mechanism
#[derive(Debug, Clone, Default, clap::Args)]
#[command(after_help = "Example:\n  bgdyn import ur5.urdf -o specs/ur5.yaml\n  \
    bgdyn import pr2.urdf --chain torso_lift_link r_gripper_tool_frame --lock r_wrist_roll_joint=0.5\n  \
    bgdyn import go2.urdf --base floating\n  bgdyn import humanoid.xml\n  bgdyn import gripper.sdf --base fixed\n  \
    bgdyn import ur5.csv --convention standard\n\n\
    The module is named after the output file. A report on stderr lists changed names, what was \
    written and what was not imported.")]
pub struct ImportArgs {
    /// The URDF (a xacro file must be expanded first), the MJCF, the SDF, or a table `.csv`; `-` reads it from standard input
    #[arg(value_name = "FILE")]
    pub file: PathBuf,
    /// Output file [default: stdout]
    #[arg(short, long, value_name = "FILE.yaml")]
    pub output: Option<PathBuf>,
    /// Fix this joint at VALUE, such as `90deg` or `20 mm`; rad or m if no unit is given, 0 if no value is given. May be repeated
    #[arg(long, value_name = "JOINT[=VALUE]", value_parser = Lock::parse)]
    pub lock: Vec<Lock>,
    /// Keep only the links from BASE to TIP and the links fixed to them; BASE is fixed to the world
    #[arg(long, value_names = ["BASE", "TIP"], num_args = 2)]
    pub chain: Vec<String>,
    /// Set `snap` in the mechanism, such as `1e-9` or `0.01 deg`: directions closer than this to an exact direction are made exact
    #[arg(long, value_name = "VALUE", value_parser = snap)]
    pub snap: Option<f64>,
    /// Convert these links to frames, separated by commas, or `all`; only links without inertia on fixed joints can be converted
    #[arg(long, value_name = "LIST", value_delimiter = ',')]
    pub frames: Vec<String>,
    /// The joint between the world and the link that has no joint
    #[arg(long, value_enum, value_name = "KIND")]
    pub base: Option<Base>,
    /// Leave damping, friction, springs and rotors of joints out, which are otherwise declared as effects
    #[arg(long)]
    pub no_effects: bool,
    /// The convention for rows of a table that do not state one
    #[arg(long, value_enum)]
    pub convention: Option<Convention>,
}

fn snap(text: &str) -> Result<f64, String> {
    let value = value(text, &[Dimension::Angle])?.to_f64();
    let fits = (0.0..=1e-3).contains(&value);
    fits.then_some(value)
        .ok_or_else(|| format!("{value} rad: snap is from 0 to 1e-3 rad"))
}

/// Runs `bgdyn import`.
pub fn run(args: ImportArgs) -> Result<()> {
    let path = shown(&args.file);
    let text = read_text(&args.file)?;
    let options = Options {
        lock: args.lock,
        chain: <[String; 2]>::try_from(args.chain).ok(),
        snap: args.snap,
        frames: args.frames,
        no_effects: args.no_effects,
        base: args.base,
        folder: folder(&args.file),
    };
    let ending = args.file.extension();
    let table = match is_stdin(&args.file) {
        true => !text
            .trim_start_matches('\u{feff}')
            .trim_start()
            .starts_with('<'),
        false => ending.is_some_and(|ending| ending.eq_ignore_ascii_case("csv")),
    };
    let made = match table {
        true => {
            let stem = match is_stdin(&args.file) {
                true => STDIN_NAME.into(),
                false => args.file.file_stem().unwrap_or_default().to_string_lossy(),
            };
            import_table(&text, &stem, args.convention, &options)
        }
        false if args.convention.is_some() => Err(anyhow!(
            "--convention is for a table, a file that ends in .csv"
        )),
        false => import_with(&text, &options),
    };
    let mut made = made.map_err(|error| {
        // A position in the file follows its path without a space.
        let place = error.to_string().starts_with(|c: char| c.is_ascii_digit());
        anyhow!("{path}:{}{error}", if place { "" } else { " " })
    })?;
    let mut to = String::new();
    match &args.output {
        Some(output) => {
            std::fs::write(output, &made.yaml)
                .with_context(|| format!("{} cannot be written", output.display()))?;
            made.warnings.extend(unfit_stem(output, &made.name));
            to = format!("{}, ", output.display());
        }
        None => print(&made.yaml)?,
    }
    for note in &made.notes {
        tell(&format!("renamed: {note}\n"));
    }
    for warning in &made.warnings {
        tell(&format!("warning: {warning}\n"));
    }
    tell(&format!("written: {to}{}\n", made.written));
    Ok(())
}

/// Returns the folder of a file; the current one for standard input.
fn folder(file: &Path) -> Option<PathBuf> {
    match is_stdin(file) {
        true => Some(PathBuf::new()),
        false => file.parent().map(Path::to_owned),
    }
}

/// Returns a warning if the module cannot have the name of the file.
fn unfit_stem(output: &Path, name: &str) -> Option<String> {
    let file = output.file_name()?.to_string_lossy().into_owned();
    let stem = file.split('.').next().unwrap_or_default();
    let unfit = !naming::is_identifier(stem);
    unfit.then(|| {
        format!("a module cannot be called `{stem}`: rename {file}, for example to {name}.yaml")
    })
}
