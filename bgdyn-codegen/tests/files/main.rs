//! Tests of what is read and written: messages, the reader, specs of the repository, build scripts, generated text.

mod all_faults_reported;
mod build_script;
#[path = "../common/mod.rs"]
mod common;
mod examples;
mod invalid;
mod messages_in_one_folder;
mod reader;
mod specs;
mod text;
