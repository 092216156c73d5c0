#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| steradian_fuzz::stored(bytes));
