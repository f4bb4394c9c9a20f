//! Links the extension module where linkers want to know that Python comes later, as on macOS.

fn main() {
    pyo3_build_config::add_extension_module_link_args();
}
