//! Rules that no table of the library has, and what people hit with these shaders: each with the cases that hold it.

use super::probe::PROBES;
use texcrd::isa::Version;

/// A rule: where it stands, what it says, and its cases without their extension. `*` stands for a version; there is a case for each
/// version of that kind of shader that has what the rule is about, at least for one.
type Rule = (&'static str, &'static str, &'static [&'static str]);

/// Defaults and lifetimes: `registers.md`.
const REGISTERS: &[Rule] = &[
    (
        "2.1",
        "inputs of fewer components, and inputs that nothing feeds",
        &["registers/inputs_vs_*"],
    ),
    (
        "2.2",
        "what is set replaces a definition",
        &[
            "registers/def_vs_overridden_*",
            "registers/def_ps_overridden_*",
        ],
    ),
    (
        "2.2",
        "the last of two definitions counts",
        &["registers/def_twice_*"],
    ),
    (
        "2.1, 3.3",
        "constants that nobody sets are 0",
        &["registers/constants_vs_*", "registers/constants_unset_*"],
    ),
    (
        "2.3",
        "a0.x takes the x slot after the swizzle",
        &["registers/address_component"],
    ),
    ("2.3", "a0.x is the floor", &["registers/address_floor"]),
    ("2.3", "a0.x of NaN", &["registers/address_nan"]),
    (
        "2.3",
        "addresses out of range, and negative ones in range",
        &["registers/address_range"],
    ),
    (
        "2.4",
        "outputs that are never written",
        &[
            "registers/outputs_unwritten_*",
            "registers/unwritten_reaches_pixels",
        ],
    ),
    (
        "2.4",
        "outputs that are written in part",
        &["registers/outputs_partly_written_*"],
    ),
    (
        "2.4",
        "oD# and oFog are clamped, oT# and oPts are not",
        &[
            "registers/outputs_clamped_*",
            "registers/coordinates_not_clamped_*",
        ],
    ),
    (
        "2.4",
        "oFog under a full mask is its x, else the component that is written",
        &["registers/fog_component_*"],
    ),
    (
        "2.4",
        "oFog that is never written is full fog",
        &["states/fog_unwritten"],
    ),
    (
        "2.4",
        "oPts that is never written is the point size",
        &["registers/point_size_*"],
    ),
    ("3.2", "v# is clamped", &["registers/colors_clamped_*"]),
    (
        "3.2",
        "vertex constants are not clamped",
        &["registers/constants_vs_*"],
    ),
    (
        "3.2",
        "t# as a source is a result, as a destination a coordinate set",
        &["texture-ps-1-0-to-1-3/results_are_not_coordinates_*"],
    ),
    (
        "3.3",
        "missing coordinates are 0",
        &["texture-ps-1-0-to-1-3/texcoord_missing_*"],
    ),
    (
        "3.3",
        "nothing bound is opaque black",
        &["samplers/unbound", "samplers/unbound_before_1_4_*"],
    ),
    (
        "3.4",
        "colours persist over phase",
        &["pairs-and-phases/phase_keeps_color"],
    ),
    (
        "4.3",
        "registers are not clamped between instructions",
        &["registers/beyond_1_*"],
    ),
];

/// What instructions do beyond their formulas: `instructions.md`.
const INSTRUCTIONS: &[Rule] = &[
    (
        "2.3",
        "scalar instructions read the w slot",
        &["arithmetic-vs/scalar_reads_w_*"],
    ),
    (
        "2.8",
        "matrix macros leave components without a row alone",
        &["arithmetic-vs/matrix_under_other_masks_*"],
    ),
    (
        "2.8",
        "the rows may be registers of any file",
        &["arithmetic-vs/matrix_in_registers"],
    ),
    (
        "5",
        "a pair of mov r0.a and cnd tests the old r0.a",
        &["arithmetic-ps/cnd_pair_*"],
    ),
    (
        "5",
        "cnd before ps.1.4 asks one number for all components",
        &["arithmetic-ps/cnd_ps_*"],
    ),
    (
        "5",
        "the weight of lrp is that of its second source",
        &["arithmetic-ps/lrp_ps_*"],
    ),
    (
        "6",
        "texkill takes coordinates, not what was sampled",
        &["texture-ps-1-0-to-1-3/texkill_reads_coordinates_*"],
    ),
    (
        "6",
        "texbem and texbeml take the states of their own stage",
        &["texture-ps-1-0-to-1-3/texbem_stage_*"],
    ),
    (
        "6",
        "the orientation of the bump matrix, as measured",
        &["texture-ps-1-0-to-1-3/texbem_measured_*"],
    ),
    (
        "6",
        "only the coordinates are divided, not the bump",
        &[
            "texture-ps-1-0-to-1-3/texbem_projected_3_*",
            "texture-ps-1-0-to-1-3/texbem_projected_4_*",
        ],
    ),
    (
        "6",
        "texbeml scales alpha as well, and is not clamped",
        &["texture-ps-1-0-to-1-3/texbeml_unbound_*"],
    ),
    (
        "6",
        "a bump of a cube or a volume keeps the third coordinate",
        &[
            "texture-ps-1-0-to-1-3/texbem_cube_*",
            "texture-ps-1-0-to-1-3/texbem_volume_*",
        ],
    ),
    (
        "6",
        "dependent reads of dependent reads",
        &["texture-ps-1-0-to-1-3/chained_*"],
    ),
    ("6", "texkill wins over depth", &["states/kill_wins"]),
    (
        "7.1",
        "a divisor of 0 gives 1",
        &[
            "texture-ps-1-4/divided_by_zero",
            "texture-ps-1-4/texld_dz_zero",
            "texture-ps-1-4/texld_dw",
        ],
    ),
    (
        "7.1",
        "the register is divided, then its selector is taken",
        &["texture-ps-1-4/texld_dw", "texture-ps-1-4/divided_by_zero"],
    ),
    (
        "7.2",
        "texkill of r# takes its content",
        &["texture-ps-1-4/texkill_register"],
    ),
    (
        "7.2",
        "the rows that were measured of texdepth",
        &["texture-ps-1-4/texdepth"],
    ),
    (
        "7.3",
        "bem and a dependent read",
        &["texture-ps-1-4/dependent_bump"],
    ),
];

/// What surrounds the shaders: `fixed-function.md`.
const AROUND: &[Rule] = &[
    (
        "6",
        "which component divides, by count",
        &[
            "texture-ps-1-0-to-1-3/projected_count_0",
            "texture-ps-1-0-to-1-3/projected_count_1",
            "texture-ps-1-0-to-1-3/projected_count_2",
            "texture-ps-1-0-to-1-3/projected_count_3",
            "texture-ps-1-0-to-1-3/projected_count_4",
        ],
    ),
    (
        "6",
        "coordinates of a vertex shader are divided by the fourth",
        &["texture-ps-1-0-to-1-3/projected_from_vertices"],
    ),
    (
        "6",
        "projection does nothing to other instructions, or in ps.1.4",
        &[
            "texture-ps-1-0-to-1-3/projection_not_applied_*",
            "texture-ps-1-4/texld_selectors",
        ],
    ),
    (
        "7.1",
        "a border keeps what its format lacks",
        &["samplers/border_of_formats"],
    ),
    (
        "7.1",
        "address modes do nothing to cubes",
        &["samplers/cube_ignores_address"],
    ),
    (
        "7.2",
        "a point filter on the border between two texels",
        &["samplers/point_boundary"],
    ),
    (
        "1",
        "nothing adds v1 to the colour of a pixel shader",
        &["measured/specular_not_added"],
    ),
    (
        "7.2",
        "a largest level beyond the smallest, and one without a mip filter",
        &["measured/max_mip_level"],
    ),
    (
        "11",
        "linear fog that ends where it starts",
        &["measured/fog_start_is_end"],
    ),
    (
        "11",
        "table fog without a depth test",
        &["measured/fog_without_depth_test"],
    ),
    (
        "7.2",
        "anisotropic filters magnify as linear ones",
        &["samplers/anisotropic"],
    ),
    (
        "8",
        "ties between the axes of a cube",
        &["samplers/cube_ties"],
    ),
    (
        "9",
        "the two lowest codes of a signed channel are both -1",
        &[
            "formats/signed_minimum",
            "formats/ends_of_q8w8v8u8",
            "formats/ends_of_v16u16",
        ],
    ),
    (
        "11",
        "fog leaves alpha alone; NaN is clear",
        &["states/fog_nan", "states/fog_nan_table"],
    ),
    (
        "11",
        "a table replaces oFog",
        &[
            "states/fog_table_exp",
            "states/fog_table_exp2",
            "states/fog_linear",
        ],
    ),
    (
        "11",
        "fog comes before blending",
        &["states/fog_before_blend"],
    ),
    (
        "12",
        "the alpha test compares 8 bits",
        &["states/alpha_equal"],
    ),
    (
        "13",
        "r0 is clamped on its way to the target",
        &["states/frame_clamped"],
    ),
    (
        "14",
        "the depth of the shader is tested",
        &["states/z_of_shader"],
    ),
    (
        "1",
        "fog and mask stand at either end of blending",
        &["states/fog_before_blend", "states/color_write_behind_blend"],
    ),
    (
        "1",
        "what the alpha test takes out reaches nothing",
        &["states/alpha_test_keeps_stencil_and_color"],
    ),
    (
        "2",
        "the depth range of the viewport",
        &["states/viewport_depths", "states/viewport_depths_turned"],
    ),
    (
        "6",
        "a negative divisor turns the direction into a cube round",
        &["texture-ps-1-0-to-1-3/tex_projected_cube"],
    ),
    (
        "10",
        "the bump mapping states are 0",
        &["texture-ps-1-0-to-1-3/texbem_default_states"],
    ),
    (
        "11",
        "with a vertex shader the vertex mode is ignored",
        &["states/fog_vertex_mode"],
    ),
    (
        "11",
        "without a vertex shader the fog is the alpha of the specular colour",
        &["states/fog_of_specular"],
    ),
    (
        "11",
        "start 0, end 1, density 1, black",
        &[
            "states/fog_defaults_linear",
            "states/fog_defaults_exp",
            "states/fog_defaults_exp2",
        ],
    ),
    (
        "11",
        "start and end in one place are a step",
        &["states/fog_start_is_end"],
    ),
    (
        "11",
        "depth or w, within the range of the viewport",
        &[
            "states/fog_distance_z",
            "states/fog_distance_w",
            "states/fog_distance_w_exp",
            "states/viewport_depths_and_fog",
        ],
    ),
    (
        "12",
        "rounded to the nearest of 8 bits, at both ends too",
        &[
            "states/alpha_rounded",
            "states/alpha_of_0",
            "states/alpha_of_255",
        ],
    ),
    (
        "13",
        "r0 is clamped before it is blended, the result after it",
        &[
            "states/blend_clamped_before",
            "states/blend_add_invdestcolor_srccolor",
            "states/blend_add_srcalpha_destalpha",
            "states/blend_subtract_invdestcolor_srccolor",
            "states/blend_subtract_srcalpha_destalpha",
            "states/blend_revsubtract_invdestcolor_srccolor",
            "states/blend_revsubtract_srcalpha_destalpha",
        ],
    ),
    (
        "13",
        "min and max ignore the factors",
        &[
            "states/blend_min_bothinvsrcalpha_destcolor",
            "states/blend_min_srcalpha_invsrcalpha",
            "states/blend_min_zero_zero",
            "states/blend_max_bothinvsrcalpha_destcolor",
            "states/blend_max_srcalpha_invsrcalpha",
            "states/blend_max_zero_zero",
        ],
    ),
    (
        "13",
        "the factors for both sides ignore that of the target",
        &[
            "states/blend_bothsrcalpha_before_destalpha",
            "states/blend_bothsrcalpha_before_one",
            "states/blend_bothsrcalpha_before_srcalpha",
            "states/blend_bothinvsrcalpha_before_destalpha",
            "states/blend_bothinvsrcalpha_before_one",
            "states/blend_bothinvsrcalpha_before_srcalpha",
        ],
    ),
    (
        "13",
        "the alpha of a target without alpha is 1",
        &[
            "states/without_alpha_destalpha",
            "states/without_alpha_drawn",
            "states/without_alpha_invdestalpha",
            "states/without_alpha_srcalphasat",
        ],
    ),
    (
        "14",
        "a step of the bias is 1/65535",
        &["states/z_bias", "states/z_bias_depth"],
    ),
    (
        "14",
        "the depth of the shader is clamped, and knows neither viewport nor bias",
        &["states/z_of_shader_alone"],
    ),
    (
        "14",
        "the masks of the stencil test",
        &["states/stencil_masked", "states/stencil_refs"],
    ),
];

/// What people hit with these shaders. What is not of a listing that runs (vertex declarations, seams between pixels) has its tests elsewhere.
const HIT: &[Rule] = &[
    (
        "1",
        "rcp, rsq, exp, log, expp, logp without a swizzle",
        &["arithmetic-vs/scalar_reads_w_*"],
    ),
    (
        "2",
        "m3x3 with its destination for a source",
        &["arithmetic-vs/m3x3_in_place_*"],
    ),
    (
        "3",
        "mov a0.x and expp take the same floor",
        &["registers/floors_agree"],
    ),
    (
        "4",
        "c[a0.x + n] out of range",
        &["registers/address_range"],
    ),
    (
        "5",
        "unwritten oT#, oD#, oFog",
        &[
            "registers/outputs_unwritten_*",
            "registers/unwritten_reaches_pixels",
            "states/fog_unwritten",
        ],
    ),
    (
        "6",
        "an input that the stream does not declare",
        &["registers/inputs_vs_*"],
    ),
    (
        "7",
        "constants that come with the shader",
        &["registers/def_vs_vs_*"],
    ),
    (
        "8",
        "negated and _bx2 constants before ps.1.4",
        &["modifiers/constants_*"],
    ),
    (
        "9",
        "a co-issued cnd whose mask is not .a",
        &["arithmetic-ps/cnd_pair_*"],
    ),
    (
        "10",
        "both halves of a pair read before either writes",
        &[
            "pairs-and-phases/swap_*",
            "pairs-and-phases/pair_reads_first_*",
        ],
    ),
    (
        "11",
        "asymmetric bump matrices",
        &["texture-ps-1-0-to-1-3/texbem_measured_*"],
    ),
    (
        "12",
        "texbeml: luminance and alpha",
        &["texture-ps-1-0-to-1-3/texbeml_*"],
    ),
    (
        "13",
        "signed formats: -128 and -127, missing channels",
        &["formats/signed_minimum", "formats/ends_of_v8u8"],
    ),
    (
        "14",
        "a cube where the listing says only tex",
        &["texture-ps-1-0-to-1-3/tex_cube_*"],
    ),
    (
        "15",
        "projection before ps.1.4, _dz and _dw in it",
        &[
            "texture-ps-1-0-to-1-3/tex_projected_*",
            "texture-ps-1-4/texld_dz",
            "texture-ps-1-4/texld_dw",
        ],
    ),
    (
        "16",
        "seams between the faces of a cube",
        &["samplers/cube_edge", "samplers/cube_seamless"],
    ),
    (
        "17",
        "nothing bound",
        &["samplers/unbound", "samplers/unbound_before_1_4_*"],
    ),
    (
        "18",
        "texkill tests x, y, z only",
        &[
            "texture-ps-1-0-to-1-3/texkill_special_*",
            "texture-ps-1-4/texkill_special_*",
        ],
    ),
    (
        "19",
        "texdepth with a divisor of 0",
        &["texture-ps-1-4/texdepth_special"],
    ),
    (
        "20",
        "what phase keeps and what must be written again",
        &["pairs-and-phases/phase_keeps_color"],
    ),
    (
        "21",
        "texm3x3spec with a normal of 0",
        &["texture-ps-1-0-to-1-3/texm3x3spec_long_normal_*"],
    ),
    ("22", "masks of frc", &["arithmetic-vs/frc_masks_*"]),
    (
        "23",
        "lit with a huge exponent",
        &["arithmetic-vs/lit_huge_power_*"],
    ),
    (
        "24",
        "0x0000FFFF inside an instruction ends nothing",
        &["registers/def_of_any_bits_*"],
    ),
];

#[test]
fn every_rule_has_its_cases() {
    let subjects = [
        ("registers.md", REGISTERS),
        ("instructions.md", INSTRUCTIONS),
        ("fixed-function.md", AROUND),
        ("what people hit", HIT),
    ];
    let stems: Vec<&str> = (PROBES.iter())
        .map(|probe| probe.path.rsplit_once('.').map_or("", |(stem, _)| stem))
        .collect();
    let mut gaps = String::new();
    for (subject, rules) in subjects {
        for (place, rule, files) in rules {
            for file in *files {
                let versions = Version::all().map(|version| version.name().replace('.', "_"));
                let found = match file.strip_suffix('*') {
                    None => stems.contains(file),
                    Some(start) => versions.into_iter().any(|version| {
                        let fits =
                            |stem: &&str| stem.starts_with(start) && stem.ends_with(&version);
                        stems.iter().any(fits)
                    }),
                };
                if !found {
                    gaps.push_str(&format!("{subject} {place}: {rule}: no {file}\n"));
                }
            }
        }
    }
    assert!(gaps.is_empty(), "{gaps}");
}
