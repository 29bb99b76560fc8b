#!/usr/bin/env bash
# Each layer of the tests must fail where a sign is flipped or a term dropped.
#
# Applies one change at a time to a copy of the tree, runs the tests of one layer, demands that they
# fail, and prints a table. Takes twenty minutes; not part of CI.
#
#   tests/mutations/run.sh            every mutation
#   tests/mutations/run.sh 3 7        those with these numbers
#   tests/mutations/run.sh --check    only that each text to change is in its file once; seconds
set -euo pipefail

root=$(cd "$(dirname "$0")/../.." && pwd)
# A folder of its own for what is compiled: cargo would take the copy's results for the tree's.
copy=$root/target/mutations/tree
log=$root/target/mutations/log
export CARGO_TARGET_DIR=$root/target/mutations/target
# An interrupted run must not leave half a cache behind.
export CARGO_INCREMENTAL=0
check=
if [[ ${1-} == --check ]]; then
    check=1
    shift
fi
wanted=" $* "
number=0
survivors=0

# The tree as it is, the changes not yet committed with it. Contents only: what did not change is
# not compiled again.
[[ $check ]] || mkdir -p "$copy"
[[ $check ]] || (cd "$root" && git ls-files -z --cached --others --exclude-standard) |
    while IFS= read -r -d '' file; do
        if [[ -f $root/$file ]] && ! cmp --quiet "$root/$file" "$copy/$file"; then
            mkdir -p "$(dirname "$copy/$file")"
            cp "$root/$file" "$copy/$file"
        fi
    done

# mutate LAYER FILE OLD NEW TEST…: replaces OLD, which FILE must hold once, and runs
# `cargo test TEST…`.
mutate() {
    local layer=$1 file=$2 old=$3 new=$4
    shift 4
    number=$((number + 1))
    if [[ $wanted != "  " && $wanted != *" $number "* ]]; then return; fi
    local text rest
    text=$(cat "$root/$file" 2>/dev/null || true)
    rest=${text#*"$old"}
    if [[ $rest == "$text" || $rest == *"$old"* ]]; then
        printf '%2d | %-36s | %-40s | MISSING: the file must hold this text exactly once: %s\n' \
            "$number" "$layer" "${file#bgdyn-codegen/src/}" "$old"
        survivors=$((survivors + 1))
        return
    fi
    if [[ $check ]]; then return; fi
    printf '%s\n' "${text/"$old"/"$new"}" >"$copy/$file"
    local verdict
    if ! (cd "$copy" && cargo test --quiet --no-run "$@") >"$log" 2>&1; then
        # A change of the generator may show in a build script already: as a refusal of its own check, or as
        # a mistake in what it writes, which is no test.
        if grep -q 'does not equal equation (6)' "$log"; then
            verdict="caught by the generator's own check"
        else
            verdict="does not compile: see $log"
            survivors=$((survivors + 1))
        fi
    elif (cd "$copy" && INSTA_UPDATE=no cargo test --quiet "$@") >"$log" 2>&1; then
        verdict=SURVIVED
        survivors=$((survivors + 1))
    else
        verdict="caught by $(grep -c '^    [a-z_:]*$' "$log" || true) tests"
    fi
    cp "$root/$file" "$copy/$file"
    touch "$copy/$file"
    printf '%2d | %-36s | %-40s | %s → %s | %s\n' \
        "$number" "$layer" "${file#bgdyn-codegen/src/}" "$old" "$new" "$verdict"
}

src=bgdyn-codegen/src
recursion=$src/formulation/recursion
codegen=(-p bgdyn-codegen --test)

mutate "paper oracle" $src/formulation/literal/sum.rs \
    '+ omega.cross(tensor * omega)' '- omega.cross(tensor * omega)' "${codegen[@]}" references paper_oracle::
mutate "Lagrange oracle" $recursion/inverse_dynamics.rs \
    'self.moment + p.cross(self.force)' 'self.moment - p.cross(self.force)' \
    "${codegen[@]}" references lagrange_oracle::
mutate "golden values" $recursion/motion.rs \
    'rate * (total + z)' 'rate * (total - z)' "${codegen[@]}" references golden::
mutate "golden values" $src/expr/eval.rs \
    'if b.negative => at(a) - at(&b.node)' 'if b.negative => at(a) + at(&b.node)' \
    "${codegen[@]}" references golden::
mutate "golden values of places" $src/formulation/site.rs \
    'angular = angular + column.angular.scale(rate)' 'angular = angular - column.angular.scale(rate)' \
    "${codegen[@]}" references golden_poses::
mutate "oracle of scenes: rotors" $recursion/rotors.rs \
    'efforts[rotor.joint] + carried' 'efforts[rotor.joint] - carried' "${codegen[@]}" oracle
mutate "oracle of scenes: a law" $src/effect/lugre.rs \
    'stiffness * z + damping * rate' 'stiffness * z - damping * rate' "${codegen[@]}" oracle
mutate "laws: formulations equal" $recursion/mass_matrix.rs \
    'Vec3([-y, x, b.zero()])' 'Vec3([y, x, b.zero()])' "${codegen[@]}" formulations laws::
mutate "laws: forward undoes inverse" $src/formulation/solve.rs \
    'mass[i][j] - l * row[j]' 'mass[i][j] + l * row[j]' "${codegen[@]}" formulations laws::
mutate "long chains: momenta meet axes" $recursion/common_axes.rs \
    'sum + w * l' 'sum - w * l' "${codegen[@]}" formulations long_chains::
mutate "long chains: signs in tables" $src/inner_products.rs \
    'negative: negative ^ minus' 'negative' "${codegen[@]}" formulations long_chains::
mutate "laws: gravity = dV/dq" $recursion/energies.rs \
    'energy - frames.gravity[j]' 'energy + frames.gravity[j]' "${codegen[@]}" formulations laws::
mutate "properties: T" $recursion/energies.rs \
    '(squares - products)' '(squares + products)' "${codegen[@]}" formulations properties::
mutate "properties: rates" $recursion/rotation.rs \
    'y.scale(c) - x.scale(s)' 'y.scale(c) + x.scale(s)' "${codegen[@]}" formulations properties::rates
mutate "derivatives" $src/expr/diff.rs \
    'g.mul(sin, da).flipped(true)' 'g.mul(sin, da)' "${codegen[@]}" formulations motions::derivatives
mutate "derivatives, solved" $src/formulation/derivatives/forward_dynamics.rs \
    '(-builder.expr(e)).signed()' 'builder.expr(e).signed()' "${codegen[@]}" formulations motions::derivatives
mutate "generated text" $src/emit/operation.rs \
    'if b.negative { quote!(-) }' 'if b.negative { quote!(+) }' "${codegen[@]}" files text::
mutate "compiled = evaluator" $src/emit/operation.rs \
    'if b.negative { quote!(-) }' 'if b.negative { quote!(+) }' -p compiled -- agreement::
mutate "compiled = evaluator, every scalar" $src/emit/operation.rs \
    '_ => quote!(/),' '_ => quote!(*),' -p compiled -- scalars::
mutate "compiled = equation (6)" $recursion/inverse_dynamics.rs \
    'force: spin.u * h + inertia' 'force: spin.u * h - inertia' -p compiled -- literal::
mutate "executed = counted operations" $src/expr/count.rs \
    'Node::Add(..) => operations.add += 1' 'Node::Add(..) => operations.add += 2' \
    -p compiled -- counting::

# Faults that were there once: the generator's own check must find each, and so must the tests of its topic.
once() {
    local topic=$1 file=$2 old=$3 new=$4
    shift 4
    mutate "verify: $topic" "$file" "$old" "$new" "${codegen[@]}" verify
    mutate "$topic" "$file" "$old" "$new" "${codegen[@]}" "$@"
}
once "a rotor its own joint carries" $recursion/mass_matrix.rs \
    'Ordering::Equal => *entry + (share + share)' 'Ordering::Equal => *entry' scenes rotors::
once "a rotor beyond its joint" $recursion/mass_matrix.rs \
    'Ordering::Less => *entry + share' 'Ordering::Less => *entry' scenes rotors::
once "rotors in derivatives" $recursion/derivatives/inverse_dynamics.rs \
    'own[j].whole.add_rotor(b, rotor, factor);' 'let _ = rotor;' scenes rotors::
once "rotors' joints in derivatives" $recursion/derivatives/inverse_dynamics.rs \
    'own[j].beyond.push(seen);' 'let _ = seen;' scenes rotors::
once "axes that are almost z" $recursion/geometry.rs \
    'let third = (0..3).find(|&k| exact(k));' \
    'let third = (0..3).find(|&k| exact(k) || z.0[k].abs() == Dd::ONE);' formulations noisy_axes::
once "axes almost parallel" $recursion/geometry.rs \
    'z.0[..2].iter().all(|x| x.hi().abs() < NOISE)' \
    '(z.0[2].abs() - Dd::ONE).hi().abs() < NOISE' formulations noisy_axes::
mutate "origins far from a parent without an axis" $recursion/geometry.rs \
    'origin[*k].hi().abs() <= FAR * size * z[*k].hi().abs()' 'size < f64::MAX' \
    "${codegen[@]}" joints noisy::

# Joints with several velocities.
mutate "uniform field set aside" $recursion/motion.rs \
    '*own = *own - aside.0[k]' '*own = *own + aside.0[k]' "${codegen[@]}" joints golden::
mutate "rotation folded into a quaternion" $recursion/rotation.rs \
    'w * d - x * a - (y * b + z * c)' 'w * d + x * a - (y * b + z * c)' "${codegen[@]}" joints golden::
mutate "round bodies at a ball" $recursion/inertia.rs \
    'Rotation::AboutZ(_) if self.round() => *self,' '_ if self.round() => *self,' \
    "${codegen[@]}" joints tidy::
mutate "moving base" $recursion/body_joint.rs \
    'angular: base.omega_dot,' 'angular: base.omega,' "${codegen[@]}" joints moving_base::
mutate "followers in the mass matrix" $recursion/mass_matrix.rs \
    'm.along(column) * column.effort * m.effort' 'm.along(column) * m.effort' "${codegen[@]}" joints mimic::

# Constraints.
constraint=bgdyn-codegen/src/mechanism/check/constraint
mutate "dependent joints of a row" $constraint/elimination.rs \
    'ratio: -k,' 'ratio: k,' "${codegen[@]}" joints constraint
mutate "offsets of replaced leaders" $constraint/couple.rs \
    'constant = sum(constant, leader.ratio * own);' 'constant = sum(constant, own);' "${codegen[@]}" joints constraints::
mutate "position of a joint followed in velocity" bgdyn-codegen/src/emit/joint_by_joint.rs \
    'quote! { #q + (#moved) }' 'quote! { #q - (#moved) }' -p bgdyn --test free_joints laws::
mutate "locked leaders" bgdyn-codegen/src/mechanism/lock.rs \
    'Some(leader.ratio * *at)' 'Some(*at)' "${codegen[@]}" joints coupled_scenes::

# Loops and prescribed motions.
closure=bgdyn-codegen/src/mechanism/closure
formulation=bgdyn-codegen/src/formulation
mutate "accelerations along a loop" $closure/chain.rs \
    'before.cross(along + l) + omega.cross(l);' 'before.cross(along + l);' "${codegen[@]}" loops multipliers::
mutate "levers on the side of place a" $closure/chain.rs \
    '(false, _) => -sum(&frames.segments[..=k]),' '(false, _) => sum(&frames.segments[..=k]),' \
    "${codegen[@]}" loops references::
mutate "the velocity of a rod's ends" $closure/row.rs \
    'along + v.dot(v) * (Dd::ONE / length)' 'along' "${codegen[@]}" loops multipliers::
mutate "efforts of dependent joints" $formulation/velocity_map.rs \
    'sum - row[i.0] * *l' 'sum + row[i.0] * *l' "${codegen[@]}" loops multipliers::
mutate "pivots of another branch" $formulation/elimination.rs \
    '-(before / (-determinant).pivot(size, index))' 'before / determinant' -p bgdyn --test closed_loops reach::
mutate "accelerations of prescribed joints" $formulation/prescribed.rs \
    'FreeArgument::Prescribed(k) => Some(prescribed(k, 2)),' 'FreeArgument::Prescribed(k) => Some(prescribed(k, 1)),' \
    "${codegen[@]}" joints prescribed

# Scenes with loops, wheels and knife edges.
mutate "drives of dependent joints" bgdyn-codegen/src/effort_sums/mod.rs \
    'sums.push_drives_of_dependents();' '' "${codegen[@]}" loops scenes::
mutate "rates of dependent joints" bgdyn-codegen/src/effort_sums/loops.rs \
    'sum + s * self.v[k]),' 'sum + self.v[k]),' "${codegen[@]}" loops scenes::
mutate "velocities at the start" $closure/start_velocities.rs \
    '(v - along(&map[j], &u))' 'v' "${codegen[@]}" loops starts::
mutate "closing of a step" bgdyn-sim/src/scene_positions.rs \
    'Ok(scene.close(y)? || normalized)' 'Ok(normalized)' -p bgdyn --test closed_loops scenes::
mutate "closing in a coarse scalar" bgdyn-runtime/src/closure.rs \
    'T::select(coarse, T::from_f64(CLOSED_COARSELY), fine)' 'fine' -p bgdyn --test closed_loops scenes::

if [[ $survivors -gt 0 ]]; then
    echo "$survivors mutations were not caught, or could not be made" >&2
    exit 1
fi
