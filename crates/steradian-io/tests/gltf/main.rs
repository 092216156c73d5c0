//! glTF files, built here byte by byte, and what is read from them.

mod building;
mod damage;
mod materials;
mod measuring;
mod meshes;
mod nodes;
