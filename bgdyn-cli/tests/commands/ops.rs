//! `bgdyn ops`.

use bgdyn_codegen::files::stem;
use bgdyn_codegen::method::Method;
use bgdyn_codegen::options::Options;
use serde_json::Value;

use crate::{bgdyn, root};

const SCARA: &str = "tests/golden/specs/scara4.yaml";

fn counts(arguments: &[&str]) -> Value {
    let text = bgdyn(&[&["ops", SCARA, "--json"], arguments].concat()).good();
    serde_json::from_str(&text).expect("JSON")
}

fn total(counts: &Value, method: &str) -> u64 {
    let count = &counts["functions"][method];
    let of = |kind: &str| count[kind].as_u64().expect("a number");
    of("mul") + of("add")
}

#[test]
fn one_entry_for_each_function() {
    let counts = counts(&[]);
    let keys = |value: &Value| -> Vec<String> {
        let mut keys: Vec<_> = value.as_object().expect("a map").keys().cloned().collect();
        keys.sort();
        keys
    };
    assert_eq!(keys(&counts), ["functions"]);
    let mut methods: Vec<_> = Method::OF_TRAIT.iter().map(|m| m.name(&[])).collect();
    // Followed by those of the tip.
    let others = [
        "coriolis_matrix",
        "pose_l_j4",
        "velocity_l_j4",
        "jacobian_world_l_j4",
        "jacobian_dot_v_world_l_j4",
    ];
    methods.extend(others.map(String::from));
    methods.sort();
    assert_eq!(keys(&counts["functions"]), methods);
    for method in methods {
        let count = &counts["functions"][&method];
        let kinds = ["add", "div", "mul", "other", "sincos", "sqrt"];
        assert_eq!(keys(count), kinds, "{method}");
        assert!(kinds.iter().all(|k| count[k].is_u64()), "{method}");
    }
}

/// The counts equal the executed operations of `tests/compiled`.
#[test]
fn counts_of_every_spec_are_the_models() {
    let mut specs = 0;
    for entry in root().join("specs").read_dir().expect("the folder") {
        let path = entry.expect("an entry").path();
        if path.extension().is_none_or(|ending| ending != "yaml") {
            continue;
        }
        let text = std::fs::read_to_string(&path).expect("a spec");
        let (mechanism, _) = bgdyn_codegen::read(&text, Some(&stem(&path)));
        let options = Options {
            derivatives: true,
            ..Options::default()
        };
        let model = bgdyn_codegen::selection::model(mechanism.expect("no fault"), &options)
            .expect("no names");
        let shown = path.display().to_string();
        let json = bgdyn(&["ops", &shown, "--json", "--derivatives"]).good();
        let json: Value = serde_json::from_str(&json).expect("JSON");
        let functions = json["functions"].as_object().expect("a map");
        assert_eq!(functions.len(), model.functions.len(), "{shown}");
        for function in &model.functions {
            let (name, x) = (function.name(), function.operations());
            let wanted = serde_json::json!({
                "mul": x.mul, "add": x.add, "div": x.div,
                "sqrt": x.sqrt, "sincos": x.sincos, "other": x.other,
            });
            assert_eq!(functions[name], wanted, "{shown}, {name}");
        }
        specs += 1;
    }
    assert!(specs >= 9, "{specs}");
}

#[test]
fn the_json_is_in_the_order_of_the_module() {
    let text = bgdyn(&["ops", SCARA, "--json"]).good();
    let place = |word: &str| text.find(&format!("\"{word}\"")).expect(word);
    let methods: Vec<_> = Method::OF_TRAIT
        .iter()
        .map(|m| place(&m.name(&[])))
        .collect();
    assert!(methods.is_sorted());
    assert!(place("mul") < place("add") && place("add") < place("div"));
}

#[test]
fn one_formulation_for_every_function() {
    let (cheapest, literal) = (counts(&[]), counts(&["--formulation", "literal"]));
    for method in ["inverse_dynamics", "mass_matrix"] {
        assert!(
            total(&cheapest, method) < total(&literal, method),
            "{method}"
        );
    }
    // For a method that the selected formulation does not support, the default function is generated.
    let bodies = counts(&["--formulation", "articulated_base"]);
    let recursion = counts(&["--formulation", "recursion"]);
    let forward = "forward_dynamics";
    assert_ne!(total(&bodies, forward), total(&recursion, forward));
    let least = total(&bodies, forward).min(total(&recursion, forward));
    assert_eq!(total(&cheapest, forward), least);
    for method in ["inverse_dynamics", "mass_matrix", "bias"] {
        assert_eq!(total(&cheapest, method), total(&recursion, method));
        assert_eq!(total(&cheapest, method), total(&bodies, method));
    }
}

/// Accuracy costs operations, and the other commands use the same function.
#[test]
fn accuracy_may_be_preferred() {
    let puma = "tests/golden/specs/puma560.yaml";
    let counts = |prefer: &str| -> Value {
        let text = bgdyn(&["ops", puma, "--json", "--prefer", prefer]).good();
        serde_json::from_str(&text).expect("JSON")
    };
    let (cheap, fine) = (counts("operations"), counts("accuracy"));
    let default: Value =
        serde_json::from_str(&bgdyn(&["ops", puma, "--json"]).good()).expect("JSON");
    assert_eq!(cheap, default);
    assert!(total(&cheap, "inverse_dynamics") < total(&fine, "inverse_dynamics"));
    let eval = |prefer: &str| -> Value {
        let values = "tests/golden/values/puma560.json";
        let arguments = [
            "eval",
            puma,
            "inverse_dynamics",
            "--states",
            values,
            "--prefer",
            prefer,
        ];
        serde_json::from_str(&bgdyn(&arguments).good()).expect("JSON")
    };
    assert_ne!(eval("operations"), eval("accuracy"));
}

/// Errors are measured at states with every argument: other velocities, directions, parameters of bodies.
#[test]
fn methods_with_further_arguments_are_explained() {
    let names = "adaptive_regressor,base_parameters,inverse_dynamics_along,forward_dynamics_along,inverse_dynamics_adjoint,forward_dynamics_adjoint,inverse_mass_matrix,operational_inverse_l_j4,centroidal_bias,inverse_dynamics_curvature,inverse_dynamics_second,parameter_derivatives,payload_regressor_l_j4,payload_adaptive_step_l_j4";
    let explained = bgdyn(&["ops", SCARA, "--explain", "--methods", names]).good();
    for name in names.split(',') {
        assert!(
            explained.contains(&format!("\n{name}: ")),
            "{name}: {explained}"
        );
    }
}

/// On stdout, after the table; with `--json` as part of it.
#[test]
fn explanations_are_on_stdout() {
    let plain = bgdyn(&["ops", SCARA, "--explain"]);
    assert_eq!(plain.stderr, "");
    let plain = plain.good();
    assert!(plain.starts_with("function "), "{plain}");
    for way in [
        "literal",
        "recursion",
        "recursion_own",
        "common_axes",
        "articulated",
        "articulated_base",
    ] {
        let line = format!("  {way} ");
        assert!(plain.contains(&line), "{way}: {plain}");
    }
    assert!(plain.contains("; error in f64 up to "), "{plain}");
    assert!(plain.contains("forward_dynamics: recursion: "), "{plain}");
    let json = bgdyn(&["ops", SCARA, "--explain", "--json"]);
    assert_eq!(json.stderr, "");
    let json: Value = serde_json::from_str(&json.good()).expect("JSON");
    let explained = json["explained"].as_object().expect("functions");
    let functions = json["functions"].as_object().expect("functions");
    assert!(explained.keys().eq(functions.keys()));
    for line in explained
        .values()
        .flat_map(|lines| lines.as_array().expect("lines"))
    {
        let line = line.as_str().expect("a line");
        assert!(plain.lines().any(|l| l == line), "{line}");
    }
    let without: Value = counts(&[]);
    assert!(without.get("explained").is_none());
}

/// `116 = 30 mul + 24 add + 30 × 2 sincos − 0.2 × 17 fusable`: the sum, and the sum of the parts.
fn sums(cost: &str) -> (f64, f64) {
    let number = |text: &str| -> f64 { text.parse().expect(cost) };
    let (sum, parts) = cost.split_once(" = ").expect(cost);
    let mut words = parts.split(' ').peekable();
    let (mut sign, mut total) = (1.0, 0.0);
    while let Some(word) = words.next() {
        match word {
            "+" => sign = 1.0,
            "−" => sign = -1.0,
            _ if word.starts_with(|c: char| c.is_ascii_digit()) => {
                let mut part = number(word);
                if words.next_if_eq(&"×").is_some() {
                    part *= number(words.next().expect(cost));
                }
                total += sign * part;
            }
            _ => {}
        }
    }
    (number(sum), total)
}

#[test]
fn explanations_show_what_decided() {
    let told = bgdyn(&["ops", SCARA, "--explain"]).good();
    let begin = told.find("forward_dynamics: ").expect(&told);
    let lines: Vec<&str> = told[begin..].lines().skip(1).collect();
    let end = lines.iter().position(|l| !l.starts_with(' '));
    let lines = &lines[..end.expect("another function follows")];
    let cost = lines.iter().find_map(|l| l.strip_prefix("  cost "));
    let (taken, parts) = sums(cost.expect(&told));
    assert!((taken - parts).abs() < 1e-9, "{taken} is not {parts}");
    let under = |title: &str| -> Vec<f64> {
        let all = lines.iter().skip_while(|l| !l.contains(title)).skip(1);
        let listed = all.take_while(|l| l.starts_with("    "));
        let costs = listed.map(|l| {
            let (before, _) = l.split_once(" = ").expect(l);
            let last = before.split(' ').next_back().expect(l);
            last.parse().expect(l)
        });
        costs.collect()
    };
    for title in ["plans before factoring", "formulations"] {
        let others = under(title);
        assert!(others.len() > 1, "{title}: {told}");
        assert!(others.iter().all(|&c| c >= taken), "{title}: {told}");
    }
    assert!(under("formulations").contains(&taken), "{told}");
}

#[test]
fn the_table_has_a_line_for_each_function() {
    let table = bgdyn(&["ops", SCARA]).good();
    let functions = counts(&[])["functions"].as_object().map(|f| f.len());
    assert_eq!(Some(table.lines().count() - 1), functions);
    let line = table.lines().find(|l| l.starts_with("inverse_dynamics"));
    let last = line.and_then(|l| l.split_whitespace().last());
    let expected = total(&counts(&[]), "inverse_dynamics").to_string();
    assert_eq!(last, Some(expected.as_str()));
}
