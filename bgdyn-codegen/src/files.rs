//! Paths of specs and scenes: the names of their modules, and the files that they refer to.

use std::path::Path;

use crate::format::{SceneSpec, is_scene, parse_scene};

/// Returns the name of a spec's module: the file's name up to its first dot.
pub fn stem(path: &Path) -> String {
    let name = path.file_name().map(|n| n.to_string_lossy());
    let stem = name.as_deref().and_then(|n| n.split('.').next());
    stem.unwrap_or_default().to_string()
}

/// Returns the path of a file that is given relative to another file.
pub fn beside(file: &Path, path: &str) -> std::path::PathBuf {
    file.parent().unwrap_or(Path::new("")).join(path)
}

/// Returns the mechanism that a scene's text names; `None` if the text is no scene or names none.
pub fn mechanism_of(text: &str) -> Option<String> {
    scene_of(text)?.mechanism.value().cloned()
}

/// Returns all files that a scene's text names: its mechanism, and that of its controllers' model.
pub fn files_of(text: &str) -> Vec<String> {
    let Some(scene) = scene_of(text) else {
        return Vec::new();
    };
    let own = scene.mechanism.value().cloned();
    let controllers = scene
        .mechanism_of_controllers()
        .map(|path| path.value.clone());
    let mut files: Vec<String> = own.into_iter().chain(controllers).collect();
    files.dedup();
    files
}

fn scene_of(text: &str) -> Option<SceneSpec> {
    is_scene(text).then(|| parse_scene(text).0).flatten()
}
