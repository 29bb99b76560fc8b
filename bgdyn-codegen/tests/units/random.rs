//! The generator's random numbers.

use bgdyn_codegen::random::Random;

/// The first words of the authors' program, for the seed 1234567.
#[test]
fn the_sequence_is_that_of_splitmix64() {
    let mut random = Random(1_234_567);
    let words: [u64; 3] = std::array::from_fn(|_| random.word());
    let published = [
        6_457_827_717_110_365_317,
        3_203_168_211_198_807_973,
        9_817_491_932_198_370_423,
    ];
    assert_eq!(words, published);
}
