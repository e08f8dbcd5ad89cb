//! Shortest and straightest paths on triangle meshes and smooth surfaces, exact where asked and certified always
