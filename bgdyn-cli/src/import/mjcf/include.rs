//! Replaces `<include>` by the content of the file.

use crate::import::naming::shown;
use crate::import::xml::{At, Element, fault, parse};
use anyhow::Result;
use std::collections::HashSet;
use std::path::Path;

/// Returns the element with the content of all included files. File names are relative to the folder; a file
/// can be included once. Elements of an included file have the position of the `<include>`.
pub(super) fn expand(root: &Element, folder: Option<&Path>) -> Result<Element> {
    let mut seen = HashSet::new();
    expanded(root, folder, &mut seen, None)
}

fn expanded(
    element: &Element,
    folder: Option<&Path>,
    seen: &mut HashSet<String>,
    at: Option<At>,
) -> Result<Element> {
    let mut made = Element {
        children: Vec::new(),
        at: at.unwrap_or(element.at),
        ..element.clone()
    };
    for child in &element.children {
        if child.name != "include" {
            made.children.push(expanded(child, folder, seen, at)?);
            continue;
        }
        let at = at.unwrap_or(child.at);
        let file = included(child, at, folder, seen)?;
        let content = expanded(&file, folder, seen, Some(at))?;
        made.children.extend(content.children);
    }
    Ok(made)
}

/// Returns the root element of an included file.
fn included(
    element: &Element,
    at: At,
    folder: Option<&Path>,
    seen: &mut HashSet<String>,
) -> Result<Element> {
    let Some(name) = element.get("file") else {
        return Err(fault(
            at,
            "this `<include>` names no file: `file=…` is missing",
        ));
    };
    let label = shown(name);
    let Some(folder) = folder else {
        return Err(fault(
            at,
            format_args!("the file `{label}` is included, and the folder of files is not known"),
        ));
    };
    if !seen.insert(name.to_owned()) {
        let message = format_args!("the file `{label}` is included a second time");
        return Err(fault(at, message));
    }
    let path = folder.join(name);
    let text = std::fs::read_to_string(&path).map_err(|error| {
        let path = path.display();
        fault(
            at,
            format_args!("the included file {path} cannot be read: {error}"),
        )
    })?;
    let root = parse(&text)
        .map_err(|error| fault(at, format_args!("in the included file `{label}`: {error}")))?;
    match root.name.as_str() {
        "mujoco" | "mujocoinclude" => Ok(root),
        other => Err(fault(
            at,
            format_args!(
                "the root of the included file `{label}` is `<{}>`, not `<mujoco>` or `<mujocoinclude>`",
                shown(other)
            ),
        )),
    }
}
