//! Converts names of a URDF into identifiers.

use std::collections::{HashMap, HashSet};

use bgdyn_codegen::name::{WORLD, is_keyword, snake_case};

/// Returns whether the name is valid without change: words of lower-case letters and digits joined by
/// single `_`, no reserved word.
pub(super) fn is_identifier(name: &str) -> bool {
    !name.is_empty() && identifier(name, "_") == name
}

/// Converts one name to an identifier; a reserved word gets `_kind` appended, a name without letters and
/// digits becomes `kind`.
pub(super) fn identifier(name: &str, kind: &str) -> String {
    match snake_case(name) {
        name if name.is_empty() => kind.into(),
        name if is_keyword(&name) || name == WORLD => format!("{name}_{kind}"),
        name => name,
    }
}

/// Converts all names to different identifiers. Names that are identifiers already do not change; of the
/// others, an earlier one has priority, and a clash gets `_2`, `_3`, ….
pub(super) fn identifiers(names: &[&str], kind: &str) -> Vec<String> {
    let mut used = HashSet::new();
    let kept: Vec<bool> = names
        .iter()
        .map(|name| is_identifier(name) && used.insert(name.to_string()))
        .collect();
    let mut next: HashMap<String, usize> = HashMap::new();
    let choose = |(name, kept): (&&str, bool)| {
        if kept {
            return name.to_string();
        }
        let plain = identifier(name, kind);
        if used.insert(plain.clone()) {
            return plain;
        }
        let number = next.entry(plain.clone()).or_insert(1);
        loop {
            *number += 1;
            let numbered = format!("{plain}_{number}");
            if used.insert(numbered.clone()) {
                return numbered;
            }
        }
    };
    names.iter().zip(kept).map(choose).collect()
}

/// Returns the name, or its first numbered form that is not in use.
pub(super) fn free_name(name: &str, taken: &HashSet<String>) -> String {
    let numbered = (2..).map(|number| format!("{name}_{number}"));
    let mut names = [name.to_owned()].into_iter().chain(numbered);
    names.find(|name| !taken.contains(name)).unwrap_or_default()
}

/// Renames those of which a name with one of its endings is the name of another, with `_2`, `_3`, ….
pub(super) fn separate(names: &mut [String], endings: &[&[&str]]) {
    let mut used: HashSet<String> = names.iter().cloned().collect();
    for (name, endings) in names.iter_mut().zip(endings) {
        let clashes = |name: &str| {
            endings
                .iter()
                .any(|it| used.contains(&format!("{name}{it}")))
        };
        if !clashes(name) {
            continue;
        }
        let numbered = (2..).map(|number| format!("{name}_{number}"));
        let mut fits = numbered.filter(|name| !used.contains(name) && !clashes(name));
        let new = fits.next().unwrap_or_default();
        used.insert(new.clone());
        *name = new;
    }
}

/// Returns whether a name of the robot matches the caller's name: that in the file, or that in the
/// mechanism.
pub(super) fn is_called(name: &str, asked: &str, kind: &str) -> bool {
    name == asked || identifier(name, kind) == asked
}

pub(super) fn listed<'a>(names: impl Iterator<Item = &'a str>) -> String {
    let names: Vec<String> = names.map(|name| format!("`{}`", shown(name))).collect();
    match names.as_slice() {
        [] => "none".into(),
        names => names.join(", "),
    }
}

/// Returns a name for a message or a comment, on one line.
pub(super) fn shown(name: &str) -> String {
    let visible =
        |c: char| !c.is_control() && !matches!(c, '\u{85}' | '\u{2028}' | '\u{2029}' | '\u{feff}');
    let show = |c: char| {
        if visible(c) {
            c.to_string()
        } else {
            c.escape_unicode().to_string()
        }
    };
    name.chars().map(show).collect()
}

#[cfg(test)]
mod tests {
    use super::{identifier, identifiers, is_identifier};

    #[test]
    fn names_become_identifiers() {
        for (name, wanted) in [
            ("Upper-Arm", "upper_arm"),
            ("arm (left)", "arm_left"),
            ("_base__link_", "base_link"),
            ("LHipYawLink", "l_hip_yaw_link"),
            ("FR_hip", "fr_hip"),
            ("6axis", "n6axis"),
            ("type", "type_link"),
            ("Self", "self_link"),
            ("world", "world_link"),
            ("Größe", "gr_e"),
            ("***", "link"),
            ("", "link"),
            ("a.b/c", "a_b_c"),
        ] {
            assert_eq!(identifier(name, "link"), wanted);
            assert!(is_identifier(wanted));
            assert!(!is_identifier(name), "{name}");
        }
    }

    #[test]
    fn clashes_are_numbered_and_good_names_stay() {
        let names = ["Arm", "ARM", "arm", "arm_2", "a rm", "arm"];
        assert_eq!(
            identifiers(&names, "link"),
            ["arm_3", "arm_4", "arm", "arm_2", "a_rm", "arm_5"]
        );
    }
}
