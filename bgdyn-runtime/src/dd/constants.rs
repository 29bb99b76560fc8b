//! Constants as double-doubles, rounded from 2000 bits.
// Each word is written as the shortest decimal that parses to it.
#![allow(clippy::approx_constant)]

use super::number::Dd;

impl Dd {
    /// π, half a turn in radians.
    pub const PI: Self = PI;
    /// π/2, a quarter turn in radians.
    pub const FRAC_PI_2: Self = FRAC_PI_2;
}

/// π.
pub(super) const PI: Dd = Dd {
    hi: 3.141592653589793,
    lo: 1.2246467991473532e-16,
};
/// π/2.
pub(super) const FRAC_PI_2: Dd = Dd {
    hi: 1.5707963267948966,
    lo: 6.123233995736766e-17,
};
/// 2π.
pub(super) const TAU: Dd = Dd {
    hi: 6.283185307179586,
    lo: 2.4492935982947064e-16,
};

/// 1/ln 2.
pub(super) const LOG2_E: f64 = 1.4426950408889634;
/// ln 2 is the sum of these two parts and [`LN_2_REST`]. The parts have 40 bits each, so that their small
/// multiples are exact.
pub(super) const LN_2_PARTS: [f64; 2] = [0.6931471805592082, 7.371002565161996e-13];
/// The remaining part of ln 2.
pub(super) const LN_2_REST: Dd = Dd {
    hi: 5.8029889835956905e-25,
    lo: 1.0908259040173159e-41,
};

/// 1/n! at index n.
pub(super) const INVERSE_FACTORIAL: [Dd; 29] = [
    Dd { hi: 1.0, lo: 0.0 },
    Dd { hi: 1.0, lo: 0.0 },
    Dd { hi: 0.5, lo: 0.0 },
    Dd {
        hi: 0.16666666666666666,
        lo: 9.25185853854297e-18,
    },
    Dd {
        hi: 0.041666666666666664,
        lo: 2.3129646346357427e-18,
    },
    Dd {
        hi: 0.008333333333333333,
        lo: 1.1564823173178714e-19,
    },
    Dd {
        hi: 0.001388888888888889,
        lo: -5.300543954373577e-20,
    },
    Dd {
        hi: 0.0001984126984126984,
        lo: 1.7209558293420705e-22,
    },
    Dd {
        hi: 2.48015873015873e-05,
        lo: 2.1511947866775882e-23,
    },
    Dd {
        hi: 2.7557319223985893e-06,
        lo: -1.858393274046472e-22,
    },
    Dd {
        hi: 2.755731922398589e-07,
        lo: 2.3767714622250297e-23,
    },
    Dd {
        hi: 2.505210838544172e-08,
        lo: -1.448814070935912e-24,
    },
    Dd {
        hi: 2.08767569878681e-09,
        lo: -1.20734505911326e-25,
    },
    Dd {
        hi: 1.6059043836821613e-10,
        lo: 1.2585294588752098e-26,
    },
    Dd {
        hi: 1.1470745597729725e-11,
        lo: 2.0655512752830745e-28,
    },
    Dd {
        hi: 7.647163731819816e-13,
        lo: 7.03872877733453e-30,
    },
    Dd {
        hi: 4.779477332387385e-14,
        lo: 4.399205485834081e-31,
    },
    Dd {
        hi: 2.8114572543455206e-15,
        lo: 1.6508842730861433e-31,
    },
    Dd {
        hi: 1.5619206968586225e-16,
        lo: 1.1910679660273754e-32,
    },
    Dd {
        hi: 8.22063524662433e-18,
        lo: 2.2141894119604265e-34,
    },
    Dd {
        hi: 4.110317623312165e-19,
        lo: 1.4412973378659527e-36,
    },
    Dd {
        hi: 1.9572941063391263e-20,
        lo: -1.3643503830087908e-36,
    },
    Dd {
        hi: 8.896791392450574e-22,
        lo: -7.911402614872376e-38,
    },
    Dd {
        hi: 3.868170170630684e-23,
        lo: -8.843177655482344e-40,
    },
    Dd {
        hi: 1.6117375710961184e-24,
        lo: -3.6846573564509766e-41,
    },
    Dd {
        hi: 6.446950284384474e-26,
        lo: -1.9330404233703465e-42,
    },
    Dd {
        hi: 2.4795962632247976e-27,
        lo: -1.2953730964765229e-43,
    },
    Dd {
        hi: 9.183689863795546e-29,
        lo: 1.4303150396787322e-45,
    },
    Dd {
        hi: 3.279889237069838e-30,
        lo: 1.5117542744029879e-46,
    },
];

/// The binary digits of 1/2π after the point, 64 per word, the highest first. They suffice for 320 digits
/// of the fraction of any `f64` times 1/2π.
pub(super) const INVERSE_TAU: [u64; 21] = [
    0x28be_60db_9391_054a,
    0x7f09_d5f4_7d4d_3770,
    0x36d8_a566_4f10_e410,
    0x7f94_58ea_f7ae_f158,
    0x6dc9_1b8e_9093_74b8,
    0x0192_4bba_8274_6487,
    0x3f87_7ac7_2c4a_69cf,
    0xba20_8d7d_4bae_d121,
    0x3a67_1c09_ad17_df90,
    0x4e64_758e_60d4_ce7d,
    0x2721_17e2_ef7e_4a0e,
    0xc7fe_25ff_f781_6603,
    0xfbcb_c462_d682_9b47,
    0xdb4d_9fb3_c9f2_c26d,
    0xd3d1_8fd9_a797_fa8b,
    0x5d49_eeb1_faf9_7c5e,
    0xcf41_ce7d_e294_a4ba,
    0x9afe_d7ec_47e3_5742,
    0x1580_cc11_bf1e_daea,
    0xfc33_ef08_26bd_0d87,
    0x6a78_e458_57b9_86c2,
];
