//! Random models, written as an SDF and as a mechanism. The arithmetic of poses is this file's own, in `f64`.

use bgdyn_codegen::random::Random;

type V3 = [f64; 3];

/// A pose: rotation by rows, and translation.
#[derive(Clone, Copy, Debug)]
pub struct Pose {
    pub turn: [V3; 3],
    pub xyz: V3,
}

impl Pose {
    pub const NONE: Pose = Pose {
        turn: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
        xyz: [0.0; 3],
    };

    /// Roll, pitch and yaw about fixed axes.
    fn of(xyz: V3, rpy: V3) -> Self {
        let [(sr, cr), (sp, cp), (sy, cy)] = rpy.map(f64::sin_cos);
        Pose {
            turn: [
                [cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr],
                [sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr],
                [-sp, cp * sr, cp * cr],
            ],
            xyz,
        }
    }

    pub fn random(random: &mut Random) -> Self {
        let mut three = |size: f64| [0; 3].map(|_| size * random.signed());
        Pose::of(three(0.5), three(1.4))
    }

    fn turned(&self, v: V3) -> V3 {
        std::array::from_fn(|i| (0..3).map(|j| self.turn[i][j] * v[j]).sum())
    }

    /// Returns `inner`, given in this pose's axes, in those in which this one is given.
    pub fn then(&self, inner: &Pose) -> Pose {
        let moved = self.turned(inner.xyz);
        let entry = |i: usize, j: usize| (0..3).map(|k| self.turn[i][k] * inner.turn[k][j]).sum();
        Pose {
            turn: std::array::from_fn(|i| std::array::from_fn(|j| entry(i, j))),
            xyz: std::array::from_fn(|i| self.xyz[i] + moved[i]),
        }
    }

    pub fn inverse(&self) -> Pose {
        let turn = std::array::from_fn(|i| std::array::from_fn(|j| self.turn[j][i]));
        let back = Pose {
            turn,
            xyz: [0.0; 3],
        };
        Pose {
            turn,
            xyz: back.turned(self.xyz).map(|x| -x),
        }
    }

    pub fn rpy(&self) -> V3 {
        let r = &self.turn;
        let level = r[0][0].hypot(r[1][0]);
        [
            r[2][1].atan2(r[2][2]),
            (-r[2][0]).atan2(level),
            r[1][0].atan2(r[0][0]),
        ]
    }

    /// The quaternion x, y, z, w of a rotation by less than half a turn.
    fn quaternion(&self) -> [f64; 4] {
        let [roll, pitch, yaw] = self.rpy().map(|x| (0.5 * x).sin_cos());
        let ((sr, cr), (sp, cp), (sy, cy)) = (roll, pitch, yaw);
        [
            sr * cp * cy - cr * sp * sy,
            cr * sp * cy + sr * cp * sy,
            cr * cp * sy - sr * sp * cy,
            cr * cp * cy + sr * sp * sy,
        ]
    }

    /// The element `<pose>`, in one of its notations.
    fn element(&self, random: &mut Random, relative_to: &str) -> String {
        let base = match relative_to {
            "" => String::new(),
            name => format!(" relative_to='{name}'"),
        };
        let [x, y, z] = self.xyz;
        match random.below(3) {
            0 => {
                let q = self.quaternion();
                format!(
                    "<pose{base} rotation_format='quat_xyzw'>{x:e} {y:e} {z:e} {:e} {:e} {:e} {:e}</pose>",
                    q[0], q[1], q[2], q[3]
                )
            }
            kind => {
                let degrees = kind == 1;
                let of = |x: f64| if degrees { x.to_degrees() } else { x };
                let [r, p, w] = self.rpy().map(of);
                let word = if degrees { " degrees='true'" } else { "" };
                format!("<pose{base}{word}>{x:e} {y:e} {z:e} {r:e} {p:e} {w:e}</pose>")
            }
        }
    }

    /// The value of `origin` in a mechanism.
    fn origin(&self) -> String {
        format!(
            "{{ xyz: {}, rpy: {} }}",
            number_list(&self.xyz),
            number_list(&self.rpy())
        )
    }
}

pub fn number_list(of: &V3) -> String {
    let texts = of.map(|x| format!("{x:?}"));
    format!("[{}]", texts.join(", "))
}

/// A link of a model: the frame of the mechanism, and that of the SDF.
struct Body {
    /// In the model.
    frame: Pose,
    /// In the model.
    sdf: Pose,
}

/// A model under construction. Link 0 is fixed to the world.
pub struct SdfModel {
    bodies: Vec<Body>,
    links: String,
    joints: String,
    frames: String,
    yaml_links: String,
    yaml_frames: String,
    yaml_loops: String,
}

/// Returns a random axis that is not short.
fn axis(random: &mut Random) -> V3 {
    let axis = [0; 3].map(|_| random.signed());
    match axis.iter().map(|x| x * x).sum::<f64>() > 0.1 {
        true => axis,
        false => [0.0, 0.6, -0.8],
    }
}

fn words(v: V3) -> String {
    v.map(|x| format!("{x:e}")).join(" ")
}

fn unit(v: V3) -> V3 {
    let length = v.iter().map(|x| x * x).sum::<f64>().sqrt();
    v.map(|x| x / length)
}

fn cross(a: V3, b: V3) -> V3 {
    std::array::from_fn(|i| a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3])
}

impl SdfModel {
    pub fn new() -> Self {
        SdfModel {
            bodies: vec![Body {
                frame: Pose::NONE,
                sdf: Pose::NONE,
            }],
            links: "<link name='link_0'><inertial><mass>2</mass></inertial></link>\n".into(),
            joints: "<joint name='mount' type='fixed'><parent>world</parent><child>link_0</child></joint>\n".into(),
            frames: String::new(),
            yaml_links: "  - { name: link_0, joint: { name: mount, type: fixed }, mass: 2, inertia: { xx: 1, yy: 1, zz: 1 } }\n".into(),
            yaml_frames: String::new(),
            yaml_loops: String::new(),
        }
    }

    /// Adds a link on a joint of this type; the link's frame of the SDF is anywhere.
    pub fn link(&mut self, random: &mut Random, parent: usize, kind: &str) {
        let k = self.bodies.len();
        let (name, carrier) = (format!("link_{k}"), format!("link_{parent}"));
        let origin = Pose::random(random);
        let frame = self.bodies[parent].frame.then(&origin);
        // A fixed link's axes are those of the file.
        let shift = match kind {
            "fixed" => Pose::NONE,
            _ => Pose::random(random),
        };
        let sdf = frame.then(&shift);
        let in_link = shift.inverse();
        let base = &self.bodies[parent];
        let (relative_to, place) = match random.below(4) {
            0 if parent > 0 => (format!("joint_{parent}"), base.frame),
            1 => (carrier.clone(), base.sdf),
            2 if parent > 0 => (format!("mark_{parent}"), base.sdf),
            _ => (String::new(), Pose::NONE),
        };
        let relative_to = match relative_to.as_str() {
            // The frame of a fixed joint is that of its link.
            name if name.starts_with("joint_") => name.to_owned(),
            name => name.to_owned(),
        };
        let element = place.inverse().then(&sdf).element(random, &relative_to);
        let com = [0; 3].map(|_| 0.2 * random.signed());
        let tensor = Pose::of([0.0; 3], [0; 3].map(|_| random.signed()));
        let inertial = Pose { xyz: com, ..tensor };
        let mass = 0.5 + random.unit();
        let in_sdf = in_link.then(&inertial);
        self.links += &format!(
            "<link name='{name}'>{element}<inertial><mass>{mass:e}</mass>{}<inertia><ixx>0.02</ixx><iyy>0.03</iyy><izz>0.025</izz><ixy>0.001</ixy></inertia></inertial></link>\n",
            in_sdf.element(random, "")
        );
        let joint_pose = match kind {
            "fixed" => String::new(),
            _ => in_link.element(random, ""),
        };
        let (axes, yaml, between) = self.axes(random, kind, (frame, sdf), &name);
        let word = kind;
        self.joints += &format!(
            "<joint name='joint_{k}' type='{word}'><parent>{carrier}</parent><child>{name}</child>{joint_pose}{axes}</joint>\n"
        );
        // A mark on the link, where its frame of the SDF is.
        self.frames += &format!("<frame name='mark_{k}' attached_to='{name}'/>\n");
        self.yaml_frames += &format!(
            "  - {{ name: mark_{k}, link: {name}, origin: {} }}\n",
            shift.origin()
        );
        let body = format!(
            "mass: {mass:?}, com: {}, inertia: {{ xx: 0.02, yy: 0.03, zz: 0.025, xy: 0.001, rpy: {} }}",
            number_list(&com),
            number_list(&tensor.rpy())
        );
        let origin = origin.origin();
        self.yaml_links += &match between {
            None => format!(
                "  - {{ name: {name}, parent: {carrier}, joint: {{ name: joint_{k}, {yaml}, origin: {origin} }}, {body} }}\n"
            ),
            Some(second) => format!(
                "  - {{ name: joint_{k}_cross, parent: {carrier}, joint: {{ name: joint_{k}, {yaml}, origin: {origin} }} }}\n  \
                   - {{ name: {name}, parent: joint_{k}_cross, joint: {{ name: joint_{k}_axis2, {second} }}, {body} }}\n"
            ),
        };
        self.bodies.push(Body { frame, sdf });
    }

    /// Returns the axes of a joint in the SDF, its type and axis in the mechanism, and those about the second axis.
    fn axes(
        &self,
        random: &mut Random,
        kind: &str,
        (frame, sdf): (Pose, Pose),
        name: &str,
    ) -> (String, String, Option<String>) {
        let own = axis(random);
        // The same direction in the joint's frame, the model's, or the link's.
        let element = |tag: &str, own: V3, random: &mut Random| {
            let (other, word) = match random.below(3) {
                0 => (own, String::new()),
                1 => (frame.turned(own), " expressed_in='__model__'".to_owned()),
                _ => (
                    sdf.inverse().turned(frame.turned(own)),
                    format!(" expressed_in='{name}'"),
                ),
            };
            format!("<{tag}><xyz{word}>{}</xyz></{tag}>", words(other))
        };
        let with = |word: &str| format!("type: {word}, axis: {}", number_list(&own));
        match kind {
            "fixed" => (String::new(), "type: fixed".into(), None),
            "ball" => (String::new(), "type: spherical".into(), None),
            "screw" => (
                format!(
                    "<screw_thread_pitch>0.02</screw_thread_pitch>{}",
                    element("axis", own, random)
                ),
                with("helical, lead: 0.02"),
                None,
            ),
            "universal" => {
                let second = axis(random);
                let both = element("axis", own, random) + &element("axis2", second, random);
                let other = format!("type: revolute, axis: {}", number_list(&second));
                (both, with("revolute"), Some(other))
            }
            _ => (element("axis", own, random), with(kind), None),
        }
    }

    /// Connects two links by a joint of this type, whose frame is anywhere.
    pub fn close(&mut self, random: &mut Random, [a, b]: [usize; 2], kind: &str) {
        let place = self.bodies[b].sdf.then(&Pose::random(random));
        let pose = self.bodies[b].sdf.inverse().then(&place);
        let own = axis(random);
        let mut second = unit(cross(own, [0.3, -0.5, 0.8]));
        let (axes, word, turned) = match kind {
            "fixed" => (String::new(), "weld".to_owned(), Pose::NONE),
            "ball" => (String::new(), "point".to_owned(), Pose::NONE),
            "universal" => {
                // Perpendicular to the last digit that matters.
                let z = unit(own);
                let dot: f64 = (0..3).map(|i| z[i] * second[i]).sum();
                second = unit(std::array::from_fn(|i| second[i] - dot * z[i]));
                let columns = [second, cross(z, second), z];
                let turn = std::array::from_fn(|i| std::array::from_fn(|j| columns[j][i]));
                let axes = format!(
                    "<axis><xyz>{}</xyz></axis><axis2><xyz>{}</xyz></axis2>",
                    words(own),
                    words(second)
                );
                let turned = Pose {
                    turn,
                    xyz: [0.0; 3],
                };
                (axes, "universal".to_owned(), turned)
            }
            _ => {
                let word = match kind {
                    "prismatic" => "slider",
                    _ => "hinge",
                };
                let axes = format!("<axis><xyz>{}</xyz></axis>", words(own));
                (
                    axes,
                    format!("{word}\n    axis: {}", number_list(&own)),
                    Pose::NONE,
                )
            }
        };
        self.joints += &format!(
            "<joint name='closing' type='{kind}'><parent>link_{a}</parent><child>link_{b}</child>{}{axes}</joint>\n",
            pose.element(random, "")
        );
        let at = |body: usize| {
            let own = self.bodies[body].frame.inverse().then(&place).then(&turned);
            format!("{{ link: link_{body}, origin: {} }}", own.origin())
        };
        self.yaml_loops += &format!(
            "loops:\n  - name: closing\n    type: {word}\n    a: {}\n    b: {}\n",
            at(a),
            at(b)
        );
    }

    pub fn sdf(&self) -> String {
        format!(
            "<sdf version='1.11'><world name='w'><gravity>0.5 -1 -9.7</gravity>\n<model name='m'>\n{}{}{}</model></world></sdf>",
            self.links, self.joints, self.frames
        )
    }

    pub fn yaml(&self) -> String {
        format!(
            "format: 1\ngravity: [0.5, -1, -9.7]\nlinks:\n{}frames:\n{}{}",
            self.yaml_links, self.yaml_frames, self.yaml_loops
        )
    }
}
