#include "core/stack/builder.hpp"

namespace irido {

StackBuilder::StackBuilder(Complex incident) {
    stack_.incident = material(incident);
}

std::size_t StackBuilder::material(Complex index) {
    Material constant;
    constant.model = RefractiveIndex{Constant{index.real()}, Constant{index.imag()}};
    return material(std::move(constant));
}

std::size_t StackBuilder::material(Material material) {
    for (std::size_t i = 0; i < stack_.materials.size(); ++i)
        if (stack_.materials[i] == material) return i;
    stack_.materials.push_back(std::move(material));
    return stack_.materials.size() - 1;
}

Element StackBuilder::layer(Complex index, double thickness_nm) {
    return layer_of(material(index), thickness_nm);
}

Element StackBuilder::layer_of(std::size_t material, double thickness_nm) {
    Layer layer;
    layer.material = material;
    layer.thickness_nm = thickness_nm;
    return {layer};
}

Element StackBuilder::group(std::uint64_t repeat, std::vector<Element> elements) {
    return {Group{repeat, std::move(elements)}};
}

Stack StackBuilder::over(Complex substrate) {
    return over_material(material(substrate));
}

Stack StackBuilder::over_material(std::size_t substrate) {
    stack_.substrate = substrate;
    return stack_;
}

}  // namespace irido
