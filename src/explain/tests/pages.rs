//! Pages as text and as Markdown.

use crate::explain::{self, LEAST_WIDTH, Page, Part, Role, Subject};
use crate::isa::{Opcode, Version};

fn pages() -> impl Iterator<Item = Page> {
    let every = Subject::all().map(|subject| subject.page(None));
    let each = Version::all().flat_map(|version| {
        let has = move |opcode: &Opcode| opcode.form(version).is_some();
        let all = Opcode::all().filter(has);
        all.map(move |opcode| explain::instruction(opcode, Some(version)))
    });
    every.chain(each).chain([explain::index()])
}

#[test]
fn no_line_is_wider_than_asked() {
    for page in pages() {
        for width in [LEAST_WIDTH, 50, 80] {
            let listed = |line: &str| {
                page.parts.iter().any(|part| match part {
                    Part::Listing(text) => text.lines().any(|l| l == line.trim_start()),
                    _ => false,
                })
            };
            let text = page.text(width);
            for line in text.lines() {
                let long = line.chars().count() > width && !listed(line);
                assert!(!long, "{width}: {line}");
                assert_eq!(line, line.trim_end());
            }
            assert!(!text.contains("\n\n\n") && !text.contains('\0'), "{text}");
        }
        // Narrower than can be read is as narrow as can be read.
        assert_eq!(page.text(0), page.text(LEAST_WIDTH));
    }
}

#[test]
fn styles_take_no_room() {
    for page in pages() {
        let styled = page.styled(60, |role, text| match role {
            Role::Name => format!("\u{1}{text}\u{2}"),
            _ => format!("\u{1}{text}\u{2}"),
        });
        assert_eq!(styled.replace(['\u{1}', '\u{2}'], ""), page.text(60));
        assert!(styled.starts_with(&format!("\u{1}{}\u{2}", page.name)));
    }
}

#[test]
fn all_words_of_a_page_are_in_its_text() {
    for page in pages() {
        let text: String = page.text(40).split_whitespace().collect();
        let has = |part: &str| {
            let part: String = part.split_whitespace().collect();
            assert!(text.contains(&part), "{part} in {}", page.text(40));
        };
        has(&page.title);
        for part in &page.parts {
            match part {
                Part::Heading(part) | Part::Paragraph(part) | Part::Listing(part) => has(part),
                Part::Facts(facts) => {
                    // Of several lines the label stands in the first.
                    facts.iter().for_each(|fact| has(&fact.label));
                    facts.iter().for_each(|fact| has(&fact.text));
                }
            }
        }
    }
}

#[test]
fn markdown_is_well_formed() {
    for page in pages() {
        let text = page.markdown();
        let fences = text.lines().filter(|line| line.starts_with("```")).count();
        let listings = page.parts.iter().filter(|p| matches!(p, Part::Listing(_)));
        assert_eq!(fences, 2 * listings.count(), "{text}");
        let mut code = false;
        for line in text.lines() {
            if line.starts_with("```") {
                code = !code;
                continue;
            }
            if code {
                continue;
            }
            // Outside of code, what would mean something else stands behind a backslash.
            let mut letters = line.chars().peekable();
            let mut span = false;
            let heading = line.starts_with("### ");
            let bold = line.starts_with("**") || line.starts_with("- **");
            while let Some(letter) = letters.next() {
                match letter {
                    '\\' if !span => drop(letters.next()),
                    '`' => span = !span,
                    '#' if heading && !span => {}
                    '*' if bold && !span => {}
                    '*' | '_' | '<' | '[' | ']' | '#' if !span => panic!("{letter} in {line}"),
                    _ => {}
                }
            }
            assert!(!span, "{line}");
        }
        assert!(!code, "{text}");
    }
}

#[test]
fn a_page_of_an_instruction_holds_its_row() {
    // Sections 3 and 4 of the instruction list and 4 of the token list: lrp is 0x12, one slot, r# and t# with .rgb, .a or all
    // in ps.1.0 to ps.1.3; the token of r0.rgb is 80070000, c0.r is A0000000.
    let text = explain::instruction(Opcode::Lrp, None).text(200);
    for part in [
        "lrp  linear interpolation\n",
        "token     0x12\n",
        "formula   d = s0 * s1 + (1 - s0) * s2\n",
        "written   lrp d, s0, s1, s2\n",
        "\nps.1.0 to ps.1.3\n",
        "slots      1 of 8 arithmetic\n",
        "d          r# or t#; mask .rgb, .a or .rgba\n",
        "s0 to s2   r#, v#, c# or t#; reads what the mask names; takes -, _bias, _bx2 and 1-\n",
        "in a pair  as either half\n",
        "\nps.1.4\n",
        "slots      1 of 8 arithmetic in a phase\n",
        "d          r#; any mask\n",
        "00000012  lrp\n",
        "80070000  r0.rgb\n",
        "A0000000  c0.r\n",
        "See also: mad, cnd, cmp\n",
    ] {
        assert!(text.contains(part), "{part} in\n{text}");
    }
    // One version says only what it has.
    let text = explain::instruction(Opcode::Cmp, Some(Version::Ps12)).text(200);
    assert!(text.contains("slots      2 of 8 arithmetic; at most 3 in a shader\n"));
    assert!(text.contains("  ps.1.2\n") && !text.contains("ps.1.4\n  texld"));
    // A version that does not have it says what there is.
    let all = explain::instruction(Opcode::Cmp, None);
    assert_eq!(explain::instruction(Opcode::Cmp, Some(Version::Ps11)), all);
}

#[test]
fn a_page_of_a_register_holds_its_row() {
    // Sections 1 and 3.1 of the register list.
    let text = explain::register(crate::isa::RegisterFile::Texture, None, None).text(200);
    for part in [
        "versions    ps.1.0 to ps.1.4\n",
        "registers   4, t0 to t3 in ps.1.0 to ps.1.3; 6, t0 to t5 in ps.1.4\n",
        "access      read and written in ps.1.0 to ps.1.3; read in ps.1.4\n",
        "read ports  1 in ps.1.0 and ps.1.4; 2 in ps.1.1; 3 in ps.1.2 and ps.1.3 (",
        "token       register type 3 in bits 30:28",
    ] {
        assert!(text.contains(part), "{part} in\n{text}");
    }
    // v3 is D3DVSDE_NORMAL, in vertex shaders alone: pixel shaders have v0 and v1.
    let text = explain::register(crate::isa::RegisterFile::Input, Some(3), None).text(200);
    assert!(text.contains("versions    vs.1.0 and vs.1.1\n") && text.contains("normal in"));
    let none = explain::register(crate::isa::RegisterFile::Temp, Some(99), None);
    assert!(none.text(200).contains("none has this number"));
}

#[test]
fn a_page_of_a_rule_shows_what_is_said() {
    let page = explain::find("M8", None).unwrap().remove(0);
    let text = page.text(200);
    // dp3 has no mask .a in ps.1.0 to ps.1.3.
    for part in [
        "d3d8     error\n",
        "Breaks it\n",
        "dp3",
        "error  line ",
        "Keeps it\n",
    ] {
        assert!(text.contains(part), "{part} in\n{text}");
    }
    // Every rule with an example is judged as the table says in some dialect.
    for entry in crate::rules::all().filter(|entry| !entry.breaks.is_empty()) {
        let page = explain::rule(entry);
        let said = page.parts.iter().any(|part| match part {
            Part::Facts(facts) => facts.iter().any(|fact| fact.text.starts_with("line ")),
            _ => false,
        });
        assert!(said, "{}", entry.rule.id);
    }
}

/// Section 4.3 of the register list.
#[test]
fn pages_of_models_hold_the_table_of_profiles() {
    let page = |name: &str| explain::find(name, None).unwrap().remove(0).text(200);
    let (gf3, r200) = (page("gf3"), page("r200"));
    for (text, parts) in [
        (
            &gf3,
            [
                "steps of 1/255",
                "-1 to 1",
                "2 * max(0, x) - 1",
                "code / 2^(b-1)",
            ],
        ),
        (
            &r200,
            ["steps of 1/4096", "-8 to 8", "2 * x - 1", "steps of 1/256"],
        ),
    ] {
        for part in parts {
            assert!(text.contains(part), "{part} in\n{text}");
        }
    }
    assert!(page("float").contains("--model float; the default"));
    let all = page("models");
    assert!(
        all.contains("gf3") && all.contains("steps of 1/4096"),
        "{all}"
    );
}

/// Every choice with all its values, from the one table.
#[test]
fn the_page_of_policies_lists_them_all() {
    let text = explain::policies().text(200);
    for policy in crate::policy::Policy::all() {
        let alone = explain::policy(policy).text(200);
        for value in policy.values() {
            for text in [&text, &alone] {
                assert!(
                    text.contains(value.name) && text.contains(value.about),
                    "{text}"
                );
            }
        }
        assert!(text.contains(policy.why) && alone.contains(policy.why));
        let default = policy.values()[0].name;
        assert!(alone.contains(&format!("default  {default}\n")), "{alone}");
    }
}
