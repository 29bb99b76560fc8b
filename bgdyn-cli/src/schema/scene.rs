//! Builds the JSON Schema of a scene's file.
//!
//! The mechanism determines the dimensions of inputs, coordinates and state variables, so their numbers
//! may have any unit here.

use bgdyn_codegen::declaration::keys_declared;
use bgdyn_codegen::effect::{EFFECTS, Effect};
use bgdyn_codegen::format::Dimension;
use bgdyn_codegen::scene::IntegratorName;
use bgdyn_runtime::ImpactLaw;
use serde_json::{Map, Value, json};

use super::effects::{effects, reads};
use super::parts::{described, file, identifier, object, quantity, text};

/// Returns the schema of a scene's file.
pub fn scene() -> Value {
    let named = |about: &str, item: Value| {
        described(
            about,
            json!({ "type": "object", "propertyNames": identifier(), "additionalProperties": item }),
        )
    };
    let list =
        |about: &str, item: Value| described(about, json!({ "type": "array", "items": item }));
    file(
        "A scene of bgdyn, format 1",
        "scene",
        &[
            (
                "mechanism",
                described("path of the mechanism's file, from this one", text()),
            ),
            (
                "lock",
                named("joints that are held, with their coordinates", number()),
            ),
            (
                "effects",
                list("what acts; what is not called for does not", called()),
            ),
            (
                "inputs",
                named("what drives each input", json!({ "$ref": "#/$defs/drive" })),
            ),
            (
                "effort_limits",
                described(
                    "whether the limits of efforts in the mechanism's file act",
                    json!({ "type": "boolean" }),
                ),
            ),
            ("control", control()),
            ("controller_model", controller_model()),
            (
                "initial",
                named("parts of the state at the start; 0 without", initial()),
            ),
            ("outputs", list("what the run is to tell", identifier())),
            ("integration", json!({ "$ref": "#/$defs/integration" })),
        ],
        "mechanism",
        json!({
            "course": course(),
            "drive": drive(),
            "effect": effects(),
            "changed": changes_schema(),
            "integration": integration(),
        }),
    )
}

/// Returns an included effect: a word, or a name with a value.
fn called() -> Value {
    let built_in = EFFECTS.iter().filter(|effect| effect.built_in());
    let known: Map<String, Value> = built_in
        .map(|effect| (effect.keyword().into(), setting(*effect)))
        .collect();
    let own = json!({ "if": { "required": ["type"] }, "then": { "$ref": "#/$defs/effect" }, "else": { "$ref": "#/$defs/changed" } });
    json!({ "anyOf": [
        described("a built-in effect, an effect of the mechanism, a family or a type of its effects", identifier()),
        {
            "type": "object",
            "minProperties": 1,
            "maxProperties": 1,
            "properties": known,
            "propertyNames": identifier(),
            "additionalProperties": own,
        },
    ] })
}

/// Returns the model of the controllers.
fn controller_model() -> Value {
    let values = described(
        "values of run-time parameters",
        json!({ "type": "object", "propertyNames": identifier(), "additionalProperties": number() }),
    );
    let effects = json!({ "type": "array", "items": called() });
    let keys = [
        (
            "mechanism",
            described("path of its mechanism's file, from this one", text()),
        ),
        ("effects", described("what it contains", effects)),
        ("parameters", values),
    ];
    described(
        "the model by which torques are computed, if it is not the scene's own",
        object(&keys, &[]),
    )
}

/// Returns the value of a built-in effect: that of its only key, or a mapping.
fn setting(effect: &dyn Effect) -> Value {
    let keys = effect.keys().iter();
    let keys: Vec<_> = keys
        .map(|key| (key.name, described(key.about, reads(key.reads))))
        .collect();
    let mut ways: Vec<Value> = keys.iter().map(|(_, value)| value.clone()).collect();
    ways.push(object(&keys, &[]));
    described(effect.summary(), json!({ "anyOf": ways }))
}

/// Returns an effect of the mechanism with other values: keys of any effect.
fn changes_schema() -> Value {
    let all = EFFECTS.iter().filter(|effect| !effect.built_in());
    let mut names: Vec<&str> = all
        .flat_map(|effect| keys_declared(*effect))
        .map(|key| {
            key.name
                .split_once('.')
                .map_or(key.name, |(group, _)| group)
        })
        .collect();
    names.sort_unstable();
    names.dedup();
    json!({ "type": "object", "propertyNames": { "enum": names } })
}

/// Returns a number, with or without a unit.
fn number() -> Value {
    json!({ "type": ["number", "string"] })
}

/// Returns a list of so many numbers.
fn numbers(n: usize) -> Value {
    json!({ "type": "array", "items": number(), "minItems": n, "maxItems": n })
}

/// Returns a number, or the pose of a spherical or floating joint.
fn initial() -> Value {
    let keys = [
        (
            "xyz",
            described("origin of the link in the joint's origin", numbers(3)),
        ),
        (
            "rpy",
            described("turns about the fixed axes x, y, z", numbers(3)),
        ),
        (
            "quaternion",
            described("x, y, z, w, of length 1", numbers(4)),
        ),
    ];
    json!({ "anyOf": [number(), object(&keys, &[])] })
}

/// Returns the signals in time, by their words.
fn courses() -> Vec<(&'static str, Value)> {
    let time = quantity(&[Dimension::Time]);
    let point =
        json!({ "type": "array", "prefixItems": [time, number()], "minItems": 2, "maxItems": 2 });
    let harmonic = object(
        &[
            ("amplitude", number()),
            ("frequency", quantity(&[Dimension::Frequency])),
            ("phase", quantity(&[Dimension::Angle])),
            ("offset", number()),
        ],
        &[],
    );
    let step = object(
        &[
            ("before", number()),
            ("after", number()),
            ("time", quantity(&[Dimension::Time])),
        ],
        &[],
    );
    vec![
        ("constant", number()),
        (
            "ramp",
            object(&[("from", number()), ("rate", number())], &[]),
        ),
        ("harmonic", harmonic),
        (
            "sum",
            described(
                "the sum of numbers and signals",
                json!({ "type": "array", "items": { "$ref": "#/$defs/course" }, "minItems": 1 }),
            ),
        ),
        (
            "table",
            described(
                "points [time, value], straight lines between them",
                json!({ "type": "array", "items": point, "minItems": 1 }),
            ),
        ),
        (
            "step",
            described("`before` until `time`, then `after`", step),
        ),
        (
            "trapezoidal",
            described(
                "from one value to another with a trapezoidal velocity, by two of duration, velocity, acceleration",
                point_to_point(),
            ),
        ),
        (
            "quintic",
            described(
                "from one value to another by a polynomial of fifth order, in `duration` or as fast as limits permit",
                point_to_point(),
            ),
        ),
    ]
}

/// Returns the keys of a motion from one value to another.
fn point_to_point() -> Value {
    let time = || quantity(&[Dimension::Time]);
    object(
        &[
            ("from", number()),
            ("to", number()),
            ("start", time()),
            ("duration", time()),
            ("velocity", number()),
            ("acceleration", number()),
        ],
        &[],
    )
}

fn course() -> Value {
    json!({ "anyOf": [number(), one_of(&courses())] })
}

fn drive() -> Value {
    let gain = quantity(&[Dimension::One]);
    let controller = |about: &str| {
        let keys = [
            ("target", json!({ "$ref": "#/$defs/course" })),
            ("stiffness", gain.clone()),
            ("damping", gain.clone()),
        ];
        described(about, object(&keys, &["target"]))
    };
    let mut words = courses();
    let pid = object(
        &[
            ("target", json!({ "$ref": "#/$defs/course" })),
            ("stiffness", gain.clone()),
            ("damping", gain.clone()),
            ("integral", gain.clone()),
            ("anti_windup", quantity(&[Dimension::Time])),
        ],
        &["target", "integral"],
    );
    words.extend([
        ("pd", controller("k (r − q) + d (ṙ − q̇)")),
        (
            "pid",
            described("k (r − q) + d (ṙ − q̇) + z with ż = k_i (r − q)", pid),
        ),
        (
            "computed_torque",
            controller("the scene's inverse dynamics at r̈ + d (ṙ − q̇) + k (r − q)"),
        ),
        ("hold", hold()),
    ]);
    let given = json!({ "const": "given", "description": "what the caller puts into `Input`" });
    let mut source = object(&words, &[]);
    let one_word: Vec<Value> = words
        .iter()
        .map(|(word, _)| json!({ "required": [word] }))
        .collect();
    let mut none = object(&[(LIMIT, limit())], &[LIMIT]);
    none["description"] = json!("what the caller puts into `Input`, within limits");
    source["properties"][LIMIT] = limit();
    source["oneOf"] = json!(one_word);
    json!({ "anyOf": [given, number(), source, none] })
}

/// The key of an input's limits.
const LIMIT: &str = "limit";

/// Returns the limits of an input.
fn limit() -> Value {
    described(
        "largest size of the input, or its least and its largest value",
        json!({ "anyOf": [number(), numbers(2)] }),
    )
}

/// Returns how controllers are sampled.
fn control() -> Value {
    let time = || quantity(&[Dimension::Time]);
    let sizes = || {
        json!({ "anyOf": [
            number(),
            { "type": "object", "propertyNames": identifier(), "additionalProperties": number() },
        ] })
    };
    let noise = [("position", sizes()), ("velocity", sizes())];
    let [position, velocity] = noise.clone();
    let keys = [
        ("period", described("time between two samples, s", time())),
        (
            "delay",
            described("time from a sample to its effect, s", time()),
        ),
        ("hold", json!({ "const": "zero_order" })),
        (
            "quantisation",
            described(
                "steps of sensors and of efforts",
                object(&[position, velocity, ("effort", sizes())], &[]),
            ),
        ),
        (
            "noise",
            described("standard deviations of sensors", object(&noise, &[])),
        ),
        (
            "seed",
            described(
                "seed of the noise",
                json!({ "type": "integer", "minimum": 0 }),
            ),
        ),
    ];
    described("how controllers are sampled", object(&keys, &["period"]))
}

/// Returns the controller of a joint's pose.
fn hold() -> Value {
    let course = || json!({ "$ref": "#/$defs/course" });
    let list = |item: Value, least: usize| json!({ "type": "array", "items": item, "minItems": least, "maxItems": 3 });
    let part = |target: Value, [stiffness, damping]: [Dimension; 2]| {
        let gain = |of| json!({ "anyOf": [quantity(&[of]), list(quantity(&[of]), 2)] });
        let keys = [
            ("target", target),
            ("stiffness", gain(stiffness)),
            ("damping", gain(damping)),
        ];
        object(&keys, &["target", "stiffness"])
    };
    let orientation = one_of(&[
        (
            "rpy",
            described("turns about the fixed axes x, y, z", list(course(), 3)),
        ),
        (
            "quaternion",
            described("x, y, z, w, of length 1", numbers(4)),
        ),
    ]);
    let linear = [Dimension::Stiffness, Dimension::Damping];
    let angular = [Dimension::AngularStiffness, Dimension::AngularDamping];
    let keys = [
        ("position", part(list(course(), 2), linear)),
        ("attitude", part(orientation, angular)),
        ("angle", part(course(), angular)),
    ];
    let mut held = object(&keys, &[]);
    held["minProperties"] = json!(1);
    described(
        "the pose of a planar, spherical or floating joint, by the joint's name",
        held,
    )
}

/// Returns a mapping with exactly one of these keys.
fn one_of(keys: &[(&str, Value)]) -> Value {
    let mut mapping = object(keys, &[]);
    mapping["minProperties"] = json!(1);
    mapping["maxProperties"] = json!(1);
    mapping
}

fn integration() -> Value {
    let methods = IntegratorName::ALL.map(IntegratorName::name);
    let time = || quantity(&[Dimension::Time]);
    let keys = [
        ("method", json!({ "enum": methods })),
        ("step", described("length of a step, s", time())),
        (
            "tolerance",
            described(
                "error of a step, in place of its length",
                quantity(&[Dimension::One]),
            ),
        ),
        ("end", described("when the run ends, s", time())),
        (
            "impacts",
            described(
                "law of restitution at impacts",
                json!({ "enum": ImpactLaw::ALL.map(ImpactLaw::name) }),
            ),
        ),
    ];
    described("how the scene is run", object(&keys, &[]))
}
