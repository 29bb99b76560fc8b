//! Functions of mechanisms, each made once for all tests: searching for plans takes most of the time of these tests.

use std::collections::BTreeMap;
use std::sync::mpsc::{Receiver, Sender, channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread;

use bgdyn_codegen::bond_graph::BondGraph;
use bgdyn_codegen::choice::{Choice, Preference, prefer};
use bgdyn_codegen::formulation;
use bgdyn_codegen::function::Function;
use bgdyn_codegen::method::Method;

use super::robot::Way;

/// A function that a test asks for, and where it is sent.
type Order = (Way, Method, Sender<Arc<Function>>);

/// The thread that makes the functions of one mechanism. A choice remembers what it found, but only for its own
/// thread.
pub type Maker = Sender<Order>;

/// How many makers are kept for further tests: each holds all that its search found.
const KEPT: usize = 40;

/// The makers with the texts of their specs, the last used at the end.
static MAKERS: Mutex<Vec<(String, Maker)>> = Mutex::new(Vec::new());

/// Returns the maker of a mechanism, started at its first use.
pub fn maker(spec: &str, graph: &Arc<BondGraph>) -> Maker {
    let mut makers = MAKERS.lock().unwrap_or_else(PoisonError::into_inner);
    let found = makers.iter().position(|(text, _)| text == spec);
    let maker = match found {
        Some(at) => makers.remove(at).1,
        None => start(graph.clone()),
    };
    makers.push((spec.to_owned(), maker.clone()));
    let surplus = makers.len().saturating_sub(KEPT);
    makers.drain(..surplus);
    maker
}

fn start(graph: Arc<BondGraph>) -> Maker {
    let (maker, orders) = channel();
    thread::spawn(move || serve(&graph, &orders));
    maker
}

/// Asks for a function. Panics if the formulation does not compute the method.
pub fn order(maker: &Maker, way: Way, method: Method) -> Arc<Function> {
    let (sender, receiver) = channel();
    let sent = maker.send((way, method, sender));
    let made = sent.ok().and_then(|()| receiver.recv().ok());
    made.unwrap_or_else(|| {
        panic!("{method:?} by {way:?} is not made; the thread's message says why")
    })
}

fn serve(graph: &BondGraph, orders: &Receiver<Order>) {
    let mut choices = BTreeMap::new();
    let mut made = BTreeMap::new();
    for (way, method, sender) in orders {
        let new = || {
            Choice::new(
                graph,
                way.map(|name| formulation::by_name(name).expect("a formulation")),
            )
        };
        let choice = choices.entry(way).or_insert_with(new);
        let function = made
            .entry((way, method))
            .or_insert_with(|| Arc::new(make(choice, way, method)));
        // A test that failed no longer waits.
        sender.send(function.clone()).ok();
    }
}

fn make(choice: &Choice<'_>, way: Way, method: Method) -> Function {
    let made = prefer(choice, method, Preference::default());
    let made = made.unwrap_or_else(|| panic!("{way:?} does not know {method:?}"));
    if let Some(name) = way {
        let derived = [
            Method::InverseDynamicsDerivatives,
            Method::ForwardDynamicsDerivatives,
            Method::ConstraintBias,
        ];
        let derived = derived.contains(&method) || Method::OF_LOOPS.contains(&method);
        let own = made.formulation.contains(name) || derived;
        assert!(own, "{method:?} by {name} is by {}", made.formulation);
    }
    made
}
