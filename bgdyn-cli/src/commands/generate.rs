//! `bgdyn generate`: prints the source text of a module, or writes the files of another backend.

use std::path::{Path, PathBuf};

use anyhow::{Context, Result, anyhow};
use bgdyn_codegen::backend::FilesError;
use bgdyn_codegen::backend::{
    BACKENDS, Backend, BackendError, GeneratedFile, GivenOptions, backend_named,
};
use bgdyn_codegen::pipeline::generate_files;
use clap::Args;

use crate::output::{print, tell};
use crate::spec_file::{GeneratorArgs, SpecFile, is_stdin, read_text};
use crate::usage::Usage;

/// Returns the backends with what they write.
fn backends() -> String {
    let each = BACKENDS.map(|backend| format!("`{}` ({})", backend.name(), backend.summary()));
    format!("The backend: {}", each.join(" or "))
}

/// Returns the options of all backends.
fn backend_options() -> String {
    let of = |backend: &dyn Backend| {
        let names = backend
            .options()
            .iter()
            .map(|option| format!("`{}`", option.name));
        format!(
            "`{}`: {}",
            backend.name(),
            names.collect::<Vec<_>>().join(", ")
        )
    };
    let each = BACKENDS.map(of);
    format!(
        "An option of the backend, such as `prefix=arm`; may be repeated; {}",
        each.join("; ")
    )
}

/// Write the generated source: a Rust module, or the files of another backend
#[derive(Args)]
#[command(
    after_help = "Example:\n  bgdyn generate specs/scara.yaml -o scara.rs\n  bgdyn generate specs/scara.yaml -o scara.rs --check   # exit 1 if scara.rs is not up to date\n  bgdyn generate specs/scara.yaml --plain   # infix formulas\n  bgdyn generate specs/scara.yaml --backend c -o src --option prefix=arm   # src/scara.h, src/scara.c"
)]
pub(crate) struct Generate {
    /// The spec
    file: PathBuf,
    #[arg(long, value_name = "NAME", default_value = BACKENDS[0].name(), help = backends())]
    backend: String,
    #[arg(long = "option", value_name = "NAME=VALUE", help = backend_options())]
    options: Vec<String>,
    /// Output file [default: stdout]; of a backend with several files, their folder [default: this one]
    #[arg(short, long)]
    output: Option<PathBuf>,
    /// Write nothing; fail if the output file differs from what would be written
    #[arg(long, requires = "output")]
    check: bool,
    /// Name of the module [default: the name of the file]
    #[arg(long, value_name = "NAME")]
    module: Option<String>,
    /// Visibility of the module [default: pub]
    #[arg(long, value_name = "RUST")]
    visibility: Option<String>,
    /// Path of bgdyn in the crate that includes the file [default: ::bgdyn]
    #[arg(long = "crate", value_name = "PATH")]
    bgdyn: Option<String>,
    /// Do not compare the functions with equation (6)
    #[arg(long)]
    no_verify: bool,
    /// Write infix formulas, for reading and review: `a * b + c` in place of `T::mul_add(a, b, c)`.
    /// The statements are those of the compiled code; this text itself does not compile
    #[arg(long)]
    plain: bool,
    #[command(flatten)]
    asked: GeneratorArgs,
}

impl Generate {
    pub(crate) fn run(self) -> Result<()> {
        let backend = backend_named(&self.backend).map_err(Usage)?;
        let (mut options, given) = (self.asked.options()?, self.given(backend)?);
        options.verify = !self.no_verify;
        let spec = SpecFile::open(&self.file)?;
        let load = |path: &str| spec.load(path);
        let found = generate_files(&spec.with_load(&load), &options, backend, &given);
        let (files, warnings) = found.map_err(|error| match error {
            FilesError::Refused(refusal) => spec.refused(refusal),
            FilesError::Backend(error) => of_backend(error),
        })?;
        tell(&spec.render(&warnings));
        match files.as_slice() {
            [file] => match &self.output {
                None => print(&file.text),
                Some(path) => self.write(path, &file.text),
            },
            files => self.write_all(files),
        }
    }

    /// Writes files to the output folder, which is created if it does not exist.
    fn write_all(&self, files: &[GeneratedFile]) -> Result<()> {
        let folder = self.output.as_deref().unwrap_or(Path::new("."));
        if !self.check {
            let named_as_file = |file: &GeneratedFile| {
                let ending = Path::new(&file.name).extension();
                ending == folder.extension() && ending.is_some() && !folder.is_dir()
            };
            if files.iter().any(named_as_file) {
                let (shown, names) = (folder.display(), files.iter().map(|file| &*file.name));
                let names = names.collect::<Vec<_>>().join(" and ");
                let message = format!("`-o {shown}` is the folder of {names}: name a folder");
                return Err(Usage(message).into());
            }
            std::fs::create_dir_all(folder)
                .with_context(|| format!("{} cannot be created", folder.display()))?;
            for file in files {
                may_be_written(&folder.join(&file.name), &file.text)?;
            }
        }
        let mut each = files.iter();
        each.try_for_each(|file| self.write(&folder.join(&file.name), &file.text))
    }

    /// Writes a file, or compares it.
    fn write(&self, path: &Path, text: &str) -> Result<()> {
        if self.check {
            return self.compare(path, text);
        }
        std::fs::write(path, text).with_context(|| format!("{} cannot be written", path.display()))
    }

    /// Returns the options of the backend, and the name of the spec.
    fn given(&self, backend: &dyn Backend) -> Result<GivenOptions> {
        let source = match is_stdin(&self.file) {
            true => "standard input".into(),
            false => self.file.file_name().unwrap_or_default().to_string_lossy(),
        };
        let of_rust = [
            ("module", self.module.clone()),
            ("visibility", self.visibility.clone()),
            ("crate", self.bgdyn.clone()),
            ("plain", self.plain.then(|| "yes".to_string())),
        ];
        let of_rust = of_rust.into_iter();
        let mut pairs: Vec<(String, String)> = of_rust
            .filter_map(|(name, value)| Some((name.to_string(), value?)))
            .collect();
        for option in &self.options {
            let Some((name, value)) = option.split_once('=') else {
                let message = format!("`--option {option}` has no value: write NAME=VALUE");
                return Err(Usage(message).into());
            };
            pairs.push((name.to_string(), value.to_string()));
        }
        let (name, options) = (backend.name(), backend.options());
        GivenOptions::new(source.into_owned(), name, options, pairs).map_err(of_backend)
    }

    /// Fails unless the file at `path` contains `text`.
    fn compare(&self, path: &Path, text: &str) -> Result<()> {
        let found = read_text(path)?;
        if found == text {
            return Ok(());
        }
        let mut lines = (1..).zip(found.lines().zip(text.lines()));
        let differs = lines.find(|(_, (found, wanted))| found != wanted);
        let line = differs.map_or_else(
            || found.lines().count().min(text.lines().count()) + 1,
            |(number, _)| number,
        );
        Err(anyhow!(
            "{}:{line}:1: this is not what {} gives; write it anew with `bgdyn generate`",
            path.display(),
            self.file.display()
        ))
    }
}

/// The words before the name of the spec in the first line of a generated file.
const FROM: &str = "Generated by bgdyn ";

/// Returns the spec of a generated file, by its first line: the text after the version.
fn spec_of(text: &str) -> Option<&str> {
    let (_, after) = text.lines().next()?.split_once(FROM)?;
    Some(after.split_once(" from ")?.1)
}

/// Fails where a file cannot be written, before any other is: a folder has its name, or it is generated from another
/// spec.
fn may_be_written(path: &Path, text: &str) -> Result<()> {
    if path.is_dir() {
        return Err(anyhow!(
            "{} cannot be written: it is a folder",
            path.display()
        ));
    }
    let found = std::fs::read_to_string(path).unwrap_or_default();
    match (spec_of(&found), spec_of(text)) {
        (Some(before), Some(now)) if before != now => Err(anyhow!(
            "{}:1:1: this file is generated from {} and would be replaced by that from {}: choose another folder, or delete it",
            path.display(),
            before.trim_end_matches(&['.', ' ', '*', '/'][..]),
            now.trim_end_matches(&['.', ' ', '*', '/'][..]),
        )),
        _ => Ok(()),
    }
}

/// Returns the error of a backend: a wrong call.
fn of_backend(error: BackendError) -> anyhow::Error {
    let BackendError::Option(message) = error;
    Usage(message).into()
}
