//! The formulas of the tables, read as arithmetic, against the machine.

use crate::diagnostic::SourceMap;
use crate::exec::{Environment, Machine, bind_constants};
use crate::isa::modifier::ResultSuffix;
use crate::isa::{Class, Form, Opcode, ResultModifier, SourceModifier, Version};
use crate::kernel::{Options, Slot, lower};
use crate::semantics::{self, Finish};
use crate::syntax;

/// A formula on its way through the reader: the numbers that names stand for are asked of `value`, for the component that is
/// computed.
struct Reader<'a> {
    words: Vec<String>,
    at: usize,
    component: usize,
    value: &'a dyn Fn(&str, usize) -> f64,
}

/// Names with their components, numbers, operators.
fn words(text: &str) -> Vec<String> {
    let mut words: Vec<String> = Vec::new();
    let mut rest = text.chars().peekable();
    while let Some(letter) = rest.next() {
        let mut word = letter.to_string();
        if letter.is_ascii_alphanumeric() {
            while let Some(next) = rest.next_if(|c| c.is_ascii_alphanumeric() || *c == '.') {
                word.push(next);
            }
        } else if "<>=&".contains(letter) {
            word.extend(rest.next_if(|next| "=&".contains(*next)));
        }
        if letter != ' ' {
            words.push(word);
        }
    }
    words
}

impl Reader<'_> {
    fn peek(&self) -> &str {
        self.words.get(self.at).map_or("", String::as_str)
    }

    fn take(&mut self, word: &str) -> bool {
        let is = self.peek() == word;
        self.at += usize::from(is);
        is
    }

    #[track_caller]
    fn need(&mut self, word: &str) {
        assert!(
            self.take(word),
            "{word} before {:?}",
            &self.words[self.at..]
        );
    }

    fn choice(&mut self) -> f64 {
        let condition = self.condition();
        if !self.take("?") {
            return condition;
        }
        let yes = self.choice();
        self.need(":");
        let no = self.choice();
        if condition != 0.0 { yes } else { no }
    }

    fn condition(&mut self) -> f64 {
        let mut left = self.comparison();
        while self.take("&&") {
            let right = self.comparison();
            left = f64::from(left != 0.0 && right != 0.0);
        }
        left
    }

    fn comparison(&mut self) -> f64 {
        let left = self.sum();
        for (word, holds) in [
            (">=", f64::ge as fn(&f64, &f64) -> bool),
            (">", f64::gt),
            ("<", f64::lt),
            ("==", f64::eq),
        ] {
            if self.take(word) {
                return f64::from(holds(&left, &self.sum()));
            }
        }
        left
    }

    fn sum(&mut self) -> f64 {
        let mut left = self.product();
        loop {
            if self.take("+") {
                left += self.product();
            } else if self.take("-") {
                left -= self.product();
            } else {
                return left;
            }
        }
    }

    fn product(&mut self) -> f64 {
        let mut left = self.power();
        loop {
            if self.take("*") {
                left *= self.power();
            } else if self.take("/") {
                left /= self.power();
            } else {
                return left;
            }
        }
    }

    fn power(&mut self) -> f64 {
        let base = self.atom();
        match self.take("^") {
            true => base.powf(self.atom()),
            false => base,
        }
    }

    /// Numbers between parentheses: one, or one for each component.
    fn list(&mut self) -> Vec<f64> {
        let mut all = vec![self.choice()];
        while self.take(",") {
            all.push(self.choice());
        }
        self.need(")");
        all
    }

    fn atom(&mut self) -> f64 {
        let word = self.peek().to_string();
        self.at += 1;
        if word == "-" {
            return -self.power();
        }
        if word == "(" {
            let all = self.list();
            return if all.len() == 1 {
                all[0]
            } else {
                all[self.component]
            };
        }
        if let Ok(number) = word.parse() {
            return number;
        }
        if !self.take("(") {
            return (self.value)(&word, self.component);
        }
        match (&*word, &self.list()[..]) {
            ("abs", [x]) => x.abs(),
            ("floor", [x]) => x.floor(),
            ("sqrt", [x]) => x.sqrt(),
            ("log2", [x]) => x.log2(),
            ("max", [x, y]) => x.max(*y),
            ("clamp", [x, low, high]) => x.clamp(*low, *high),
            (name, list) => panic!("{name} of {list:?}"),
        }
    }
}

/// What a formula gives for a component.
fn evaluate(formula: &str, component: usize, value: &dyn Fn(&str, usize) -> f64) -> f64 {
    let mut reader = Reader {
        words: words(formula),
        at: 0,
        component,
        value,
    };
    let result = reader.choice();
    assert_eq!(reader.peek(), "", "{formula}");
    result
}

/// `s0.w` is a component of a source, `s0` that which is computed.
fn component_of(name: &str, component: usize) -> (&str, usize) {
    match name.split_once('.') {
        Some((stem, letter)) => {
            let at = ["xyzw", "rgba"].iter().find_map(|set| set.find(letter));
            (stem, at.unwrap())
        }
        None => (name, component),
    }
}

/// Three sources: no two numbers alike, signs and halves on both sides, none of them 0.
const SOURCES: [[[f32; 4]; 3]; 3] = [
    [
        [0.75, -0.25, 0.5, 0.625],
        [0.5, 1.0, -0.75, 0.25],
        [-1.0, 0.375, 0.875, -0.5],
    ],
    [
        [-0.375, 0.875, -1.0, 0.125],
        [0.25, -0.5, 0.75, 1.0],
        [0.625, 0.0625, -0.125, 0.375],
    ],
    [
        [0.5, 0.5, -0.0625, -0.875],
        [0.5, -0.9375, 0.25, 0.75],
        [1.0, -0.25, 0.5, 0.6875],
    ],
];

/// What the machine leaves in the destination, given these sources.
fn run(opcode: Opcode, form: &Form, version: Version, sources: &[[f32; 4]; 3]) -> [f32; 4] {
    let masks = form.destination.unwrap().masks;
    let mask = masks.iter().last().unwrap();
    let letters = crate::program::letters(version.kind());
    // cnd of ps.1.0 to ps.1.3 has its condition in r0.a; there the result goes elsewhere.
    let asks_r0 = form.formula.contains("r0.a");
    let (before, destination, first) = match asks_r0 {
        true => ("mov r0, c1\n", 1, "r0.a"),
        false => ("", 0, "c1"),
    };
    let operands = [first, "c2", "c3"][..form.sources.len()].join(", ");
    let mask = mask.text(letters);
    let mnemonic = opcode.mnemonic();
    let text = format!("{version}\n{before}{mnemonic} r{destination}{mask}, {operands}\n");
    let mut map = SourceMap::new();
    let program = syntax::parse(map.add("one", text.clone()).unwrap()).program;
    let kernel = lower(&program.unwrap(), &Options::default()).expect(&text);
    let set = [1, 2, 3].map(|i| (i, sources[i as usize - 1]));
    let mut environment = Environment {
        constants: bind_constants(&kernel, &set),
        ..Default::default()
    };
    for stage in &mut environment.stages {
        stage.bump.matrix = MATRIX;
    }
    let mut machine = Machine::<1>::new();
    machine.run(&kernel, &environment);
    machine.lane(Slot::temp(destination).unwrap(), 0)
}

/// `M00`, `M01`, `M10`, `M11`.
const MATRIX: [f32; 4] = [0.5, -2.0, 3.0, 0.25];

#[test]
fn formulas_of_arithmetic_are_what_the_machine_computes() {
    let mut compared = Vec::new();
    for opcode in Opcode::all() {
        for form in opcode.row().forms {
            let written = form.destination.is_some_and(|d| d.written);
            // The rows of matrices have no arithmetic of their own.
            if form.class != Class::Arithmetic || !written || form.rows > 0 {
                continue;
            }
            let version = form.versions.iter().last().unwrap();
            for sources in &SOURCES {
                let actual = run(opcode, form, version, sources);
                let value = |name: &str, component: usize| -> f64 {
                    if let Some(at) = ["M00", "M01", "M10", "M11"].iter().position(|m| *m == name) {
                        return MATRIX[at].into();
                    }
                    let (stem, at) = component_of(name, component);
                    let source = match stem {
                        "s0" | "r0" => sources[0],
                        "s1" => sources[1],
                        "s2" => sources[2],
                        _ => panic!("{name} in {}", form.formula),
                    };
                    source[at].into()
                };
                // Of several statements those of the destination; a0 is asked elsewhere.
                for statement in form.formula.split("; ") {
                    let (left, right) = statement.split_once(" = ").unwrap();
                    let components: Vec<usize> = match left {
                        "a0.x" => continue,
                        "d" => form
                            .destination
                            .unwrap()
                            .masks
                            .iter()
                            .last()
                            .unwrap()
                            .components()
                            .collect(),
                        one => vec![component_of(one, 0).1],
                    };
                    for c in components {
                        let expected = evaluate(right, c, &value);
                        let actual = f64::from(actual[c]);
                        // expp and logp drop eight of 24 bits.
                        let near = (actual - expected).abs() <= 1e-4 * expected.abs().max(1e-3);
                        assert!(near, "{opcode:?} {version} {c}: {actual} is not {expected}");
                    }
                }
            }
            compared.push(opcode);
        }
    }
    compared.dedup();
    // nop apart, all that compute: mov add sub mad mul rcp rsq dp3 dp4 min max slt sge exp log lit dst lrp frc expp logp cnd cmp
    // bem.
    assert_eq!(compared.len(), 24, "{compared:?}");
}

#[test]
fn formulas_of_modifiers_are_what_the_machine_computes() {
    let numbers = [-1.0f32, -0.25, 0.0, 0.375, 0.5, 1.0, 3.0];
    for modifier in SourceModifier::all() {
        let row = modifier.row();
        for x in numbers {
            if row.divides.is_some() {
                let by = |name: &str, _: usize| {
                    f64::from(if name == "x" || name == "y" { x } else { 4.0 })
                };
                let expected = evaluate(row.formula, 0, &by);
                assert_eq!(f64::from(semantics::divide(x, 4.0)), expected);
                continue;
            }
            let expected = evaluate(row.formula, 0, &|_, _| x.into());
            assert_eq!(
                f64::from(semantics::modify(modifier, x)),
                expected,
                "{modifier:?}"
            );
        }
    }
    for row in ResultSuffix::all() {
        let finish = Finish::new(ResultModifier {
            shift: row.shift,
            saturate: row.shift == 0,
        });
        for x in numbers {
            let expected = evaluate(row.formula, 0, &|_, _| x.into());
            assert_eq!(f64::from(finish.apply(x)), expected, "{}", row.suffix);
        }
    }
}

#[test]
fn the_reader_of_formulas_reads_arithmetic() {
    // 2 + 3 * 4 = 14; (2 + 3) * 4 = 20; 1 - 2 - 3 = -4; -(1 - 3) = 2; 3 * 2 ^ 3 = 24; the second of three.
    let none = |_: &str, _: usize| f64::NAN;
    for (text, result) in [
        ("2 + 3 * 4", 14.0),
        ("(2 + 3) * 4", 20.0),
        ("1 - 2 - 3", -4.0),
        ("-(1 - 3)", 2.0),
        ("3 * 2 ^ 3", 24.0),
        ("(7, 8, 9)", 8.0),
        ("1 > 2 ? 5 : 2 >= 2 && 3 < 4 ? 6 : 7", 6.0),
        ("clamp(7, 0, 1) + floor(-0.5)", 0.0),
    ] {
        assert_eq!(evaluate(text, 1, &none), result, "{text}");
    }
    assert_eq!(component_of("s1.b", 0), ("s1", 2));
}
