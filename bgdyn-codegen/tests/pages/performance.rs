//! Checks that the counts of `docs/performance.md` are those of the generator, and none is above the best
//! known one.
//!
//! After an intended change: `BGDYN_WRITE=1 cargo test -p bgdyn-codegen --test pages performance`.

use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};

use bgdyn_codegen::expr::Operations;
use bgdyn_codegen::files::stem;
use bgdyn_codegen::method::Method;
use bgdyn_codegen::options::{Options, formulation_named};
use bgdyn_codegen::read;
use bgdyn_codegen::selection::function;

/// The methods compared, with the head of their column.
const METHODS: [(Method, &str); 4] = [
    (Method::InverseDynamics, "inverse dynamics"),
    (Method::MassMatrix, "mass matrix"),
    (Method::ForwardDynamics, "forward dynamics"),
    (Method::InverseDynamicsDerivatives, "∂τ/∂q, ∂τ/∂v"),
];

/// A robot, and the fewest multiplications/additions known for each method before bgdyn; sine pairs,
/// divisions and roots of inverse and forward dynamics.
struct Robot {
    name: &'static str,
    what: &'static str,
    best: [(usize, usize); 4],
    pairs: [usize; 2],
    divisions: usize,
}

#[rustfmt::skip]
const ROBOTS: [Robot; 7] = [
    Robot { name: "scara_rrpr", what: "SCARA RRPR", best: [(29, 25), (18, 30), (57, 59), (75, 64)], pairs: [3, 2], divisions: 2 },
    Robot { name: "stanford_gen", what: "Stanford arm", best: [(202, 185), (89, 88), (348, 306), (1152, 987)], pairs: [4, 4], divisions: 5 },
    Robot { name: "puma_gen", what: "PUMA 560", best: [(220, 202), (128, 123), (407, 351), (1188, 1083)], pairs: [5, 6], divisions: 5 },
    Robot { name: "puma_arm", what: "PUMA 560, Armstrong 1986", best: [(146, 123), (80, 70), (275, 216), (692, 561)], pairs: [4, 5], divisions: 4 },
    Robot { name: "ur5_gen", what: "UR5", best: [(209, 189), (119, 116), (376, 323), (842, 819)], pairs: [5, 7], divisions: 5 },
    Robot { name: "panda_gen", what: "Panda", best: [(279, 256), (169, 160), (555, 495), (2280, 2085)], pairs: [6, 6], divisions: 6 },
    Robot { name: "iiwa_gen", what: "iiwa", best: [(261, 238), (134, 129), (499, 444), (2123, 1900)], pairs: [6, 6], divisions: 6 },
];

/// A mechanism with joints of several velocities; sums of the fewest multiplications and additions known
/// before bgdyn of inverse dynamics, mass matrix and forward dynamics, and the divisions of the last.
struct FreeRobot {
    file: &'static str,
    what: &'static str,
    best: [usize; 3],
    divisions: usize,
}

#[rustfmt::skip]
const FREE_ROBOTS: [FreeRobot; 9] = [
    FreeRobot { file: "counting/free_body_diagonal", what: "free body, diagonal inertia about the mass centre", best: [51, 0, 45], divisions: 0 },
    FreeRobot { file: "counting/free_body", what: "free body, general inertia", best: [108, 0, 126], divisions: 0 },
    FreeRobot { file: "quadrotor_arm", what: "quadrotor with a 2R arm", best: [307, 84, 498], divisions: 5 },
    FreeRobot { file: "counting/two_balls", what: "double pendulum on balls", best: [293, 202, 516], divisions: 3 },
    FreeRobot { file: "counting/three_balls", what: "chain of three balls", best: [517, 538, 1051], divisions: 6 },
    FreeRobot { file: "spherical_chain3", what: "the same, with a constant rotation", best: [545, 566, 1079], divisions: 6 },
    FreeRobot { file: "planar_base_ur5", what: "planar base with a UR5", best: [292, 139, 478], divisions: 9 },
    FreeRobot { file: "satellite_arm6", what: "satellite with a 6R arm", best: [671, 406, 1584], divisions: 12 },
    FreeRobot { file: "anymal_floating", what: "ANYmal B", best: [1244, 511, 2574], divisions: 18 },
];

/// Largest cost of derivatives relative to the best known count, that of plain forward differentiation.
const STRUCTURED: f64 = 0.7;

fn folder(path: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..").join(path)
}

fn count(path: &Path, method: Method) -> Operations {
    let text = fs::read_to_string(path).expect("a spec");
    let (mechanism, faults) = read(&text, Some(&stem(path)));
    let mechanism = mechanism.unwrap_or_else(|| panic!("{faults:?}"));
    let made = function(&mechanism, method, &Options::default());
    made.expect("a function of every method").operations()
}

fn records(text: &mut String) {
    let heads: Vec<&str> = METHODS.iter().map(|(_, head)| *head).collect();
    writeln!(
        text,
        "| robot | {} |",
        heads.join(" | best known | ") + " | best known"
    )
    .unwrap();
    writeln!(text, "|---|{}", "---|---|".repeat(METHODS.len())).unwrap();
    let (mut ours, mut best) = (0, 0);
    for robot in &ROBOTS {
        let path = folder("tests/golden/specs").join(format!("{}.yaml", robot.name));
        let mut row = format!("| {} |", robot.what);
        for (m, &(method, head)) in METHODS.iter().enumerate() {
            let (o, (mul, add)) = (count(&path, method), robot.best[m]);
            let derivative = method == Method::InverseDynamicsDerivatives;
            let share = if derivative { STRUCTURED } else { 1.0 };
            let bound = share * (mul + add) as f64;
            let place = format!("{}, {head}: {o}", robot.name);
            assert!(o.total() as f64 <= bound, "{place}: above {bound}");
            match method {
                Method::InverseDynamics => assert!(o.sincos <= robot.pairs[0], "{place}"),
                Method::ForwardDynamics => {
                    assert!(
                        o.sincos <= robot.pairs[1] && o.div <= robot.divisions,
                        "{place}"
                    );
                }
                _ => assert_eq!(o.div + o.sqrt, 0, "{place}"),
            }
            if !derivative {
                (ours, best) = (ours + o.total(), best + mul + add);
            }
            let (m, a, sum) = (o.mul, o.add, o.total());
            write!(row, " **{sum}** ({m}/{a}) | {} ({mul}/{add}) |", mul + add).unwrap();
        }
        writeln!(text, "{row}").unwrap();
    }
    let less = 100.0 * (1.0 - ours as f64 / best as f64);
    assert!(less >= 3.0, "{less}");
    let sums = "inverse dynamics, mass matrix and forward dynamics of all robots";
    writeln!(
        text,
        "\nIn the sum over {sums}: {ours} against {best}, {less:.1} % fewer."
    )
    .unwrap();
}

fn free_robots(text: &mut String) {
    let heads: Vec<&str> = METHODS[..3].iter().map(|(_, head)| *head).collect();
    let heads = heads.join(" | best known | ");
    writeln!(text, "| mechanism | {heads} | best known |").unwrap();
    writeln!(text, "|---|{}", "---|---|".repeat(3)).unwrap();
    for robot in &FREE_ROBOTS {
        let path = folder("tests/golden/joints").join(format!("{}.yaml", robot.file));
        let mut row = format!("| {} |", robot.what);
        for (&(method, head), best) in METHODS.iter().zip(robot.best) {
            let o = count(&path, method);
            let (m, a, sum) = (o.mul, o.add, o.total());
            assert!(sum <= best, "{}, {head}: {o}: above {best}", robot.file);
            let forward = method == Method::ForwardDynamics;
            let divisions = if forward { robot.divisions } else { 0 };
            assert!(
                o.div <= divisions && o.sqrt == 0,
                "{}, {head}: {o}",
                robot.file
            );
            write!(row, " **{sum}** ({m}/{a}) | {best} |").unwrap();
        }
        writeln!(text, "{row}").unwrap();
    }
}

fn own_specs(text: &mut String) {
    let heads: Vec<&str> = METHODS.iter().map(|(_, head)| *head).collect();
    writeln!(text, "| spec | {} |", heads.join(" | ")).unwrap();
    writeln!(text, "|---|{}", "---|".repeat(METHODS.len())).unwrap();
    let entries = fs::read_dir(folder("specs")).expect("a folder");
    let mut paths: Vec<PathBuf> = entries.map(|e| e.expect("an entry").path()).collect();
    paths.retain(|p| p.extension().is_some_and(|e| e == "yaml"));
    paths.sort();
    for path in paths {
        let counts = METHODS.map(|(method, _)| format!("{}", count(&path, method)));
        writeln!(text, "| `{}` | {} |", stem(&path), counts.join(" | ")).unwrap();
    }
}

#[test]
fn the_page_holds_what_is_generated() {
    let mut text = String::from(
        "# Performance\n\n\
         ## How few operations\n\n\
         Multiplications and additions of one call, as the compiled code executes them: each distinct \
         product and each sum once, negation and arithmetic on the mechanism's own numbers free, \
         the sine and cosine of an angle counted as a pair apart. All ten inertial parameters of \
         every link are random, except for Armstrong's PUMA, which has his zeros. \"Best known\" is the \
         least that was found for the same robot with any other generator, published or run, or \
         in the studies that came before this one, counted by the same rule; its derivatives are \
         plain forward differentiation of the best inverse dynamics.\n\n",
    );
    records(&mut text);
    text += "\nSine pairs, divisions and roots are never more than there. Derivatives come from composite \
             bodies instead of differentiation, for about half of the operations.\n\n\
             With [joints of several velocities](spec.md#joint-types) (`tests/golden/joints`; quaternions are \
             unit by contract). \"Best known\" is the least of Pinocchio's templates traced by CasADi and by \
             CppADCodeGen, and of a study that came before this one:\n\n";
    free_robots(&mut text);
    text += "\nThe mechanisms of [`specs/`](../specs):\n\n";
    own_specs(&mut text);
    text += "\nTo get these numbers again: `bgdyn ops FILE --derivatives`, for all of them \
             `BGDYN_WRITE=1 cargo test -p bgdyn-codegen --test pages performance`, which writes this page; \
             without `BGDYN_WRITE` the test fails where the page is not up to date, or a count is \
             above the best known one.\n";
    text += "\nArms outside this table: [outside.md](outside.md).\n";
    text += "\n## How fast\n\n\
             [peers.md](peers.md) compares times with Pinocchio, MuJoCo, KDL, dynibo and the C that CasADi \
             and CppADCodeGen generate, measured alternately by `benches/peers/run.sh`, which takes any \
             spec. [peers_control.md](peers_control.md) does so for M⁻¹, Λ, regressors, directions, \
             adjoints, second derivatives and momenta. `cargo bench` times every method of the specs next \
             to textbook recursions and needs none of these systems. [order.md](order.md) shows what each choice of order gains, \
             [compile_time.md](compile_time.md) what a model costs while compiling, [chains.md](chains.md) \
             what long chains take.\n";
    let page = folder("docs/performance.md");
    if std::env::var_os("BGDYN_WRITE").is_some() {
        fs::write(&page, &text).expect("the page is written");
    }
    let found = fs::read_to_string(&page).expect("docs/performance.md");
    assert!(
        found == text,
        "docs/performance.md is not up to date:\n{text}"
    );
}

/// README's table has the robots of the page in its order.
#[test]
fn the_readme_holds_what_is_generated() {
    let readme = fs::read_to_string(folder("README.md")).expect("a page");
    let head =
        "| robot | inverse dynamics | base parameters | literal | mass matrix | forward dynamics |";
    let table = &readme[readme.find(head).expect("the table")..];
    let literal = Options {
        formulation: Some(formulation_named("literal").expect("a formulation")),
        ..Options::default()
    };
    for (robot, row) in ROBOTS.iter().zip(table.lines().skip(2)) {
        let cells: Vec<&str> = row.trim_matches('|').split('|').map(str::trim).collect();
        let path = folder(&format!("tests/golden/specs/{}.yaml", robot.name));
        let counted = |method, options: &Options| {
            let text = fs::read_to_string(&path).expect("a spec");
            let mechanism = read(&text, Some(robot.name)).0.expect("a mechanism");
            let o = function(&mechanism, method, options)
                .expect("a function")
                .operations();
            format!("{}/{}", o.mul, o.add)
        };
        let usual = |method| counted(method, &Options::default());
        assert_eq!(
            cells[1],
            format!("**{}**", usual(Method::InverseDynamics)),
            "{row}"
        );
        assert_eq!(
            cells[3],
            counted(Method::InverseDynamics, &literal),
            "{row}"
        );
        assert_eq!(cells[4], usual(Method::MassMatrix), "{row}");
        assert_eq!(cells[5], usual(Method::ForwardDynamics), "{row}");
    }
}
