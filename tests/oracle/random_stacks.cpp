#include "tests/oracle/random_stacks.hpp"

#include <array>
#include <cmath>
#include <sstream>
#include <utility>

#include "core/material/library.hpp"

namespace irido::oracle {

std::string_view name_of(Kind kind) {
    constexpr std::array<std::string_view, kAllKinds> names{
        "film",  "film on metal", "multilayer",   "tabulated metal", "kinked table",
        "bragg", "thick film",    "metal cavity", "mirror"};
    return names[static_cast<std::size_t>(kind)];
}

namespace {

double dielectric(Random& random) {
    return random.uniform(1.2, 2.7);
}

Complex metal(Random& random) {
    return {random.uniform(0.05, 3), random.uniform(1.5, 7)};
}

Material coarse_table(Random& random) {
    Table n, k;
    const bool absorbs = random.below(2) == 0;
    for (double nm = 300; nm < 900; nm += random.uniform(8, 90)) {
        n.wavelength_nm.push_back(nm);
        n.value.push_back(random.uniform(1.3, 2.5));
        k.wavelength_nm.push_back(nm + 3);
        k.value.push_back(absorbs ? random.uniform(0, 0.5) : 0.0);
    }
    Material material;
    material.name = "coarse";
    material.model = RefractiveIndex{n, k};
    material.outside = Outside::clamp;
    return material;
}

}  // namespace

Stack random_stack(Kind kind, Random& random) {
    StackBuilder b(random.below(5) == 0 ? random.uniform(1, 1.6) : 1.0);
    const auto film = [&](double from, double to) {
        const double n = dielectric(random);
        b.add(b.layer(n, random.uniform(from, to)));
    };
    switch (kind) {
        case Kind::film:
            film(0, 1500);
            return b.over(random.uniform(1, 2.5));
        case Kind::film_on_metal:
            for (std::size_t left = 1 + random.below(2); left > 0; --left) film(0, 1200);
            return b.over(metal(random));
        case Kind::multilayer:
            for (std::size_t left = 2 + random.below(8); left > 0; --left) {
                const double n = dielectric(random);
                const double k = random.below(4) == 0 ? random.uniform(0, 0.3) : 0.0;
                b.add(b.layer({n, k}, random.uniform(5, 300)));
            }
            return b.over(random.below(2) == 0 ? Complex(1.52) : metal(random));
        case Kind::tabulated_metal: {
            constexpr std::array<const char*, 8> names{"Cu", "Au", "Ag", "Al",
                                                       "Ti", "Cr", "W",  "Si"};
            for (std::size_t left = 1 + random.below(2); left > 0; --left) film(0, 800);
            return b.over_material(
                b.material(find_material(names[random.below(names.size())]).value().material));
        }
        case Kind::kinked_table: {
            const std::size_t coarse = b.material(coarse_table(random));
            b.add(b.layer_of(coarse, random.uniform(20, 700)));
            return b.over(random.below(2) == 0 ? Complex(1.52) : metal(random));
        }
        case Kind::bragg: {
            const double n1 = dielectric(random), d1 = random.uniform(30, 200);
            const double n2 = dielectric(random), d2 = random.uniform(30, 200);
            b.add(StackBuilder::group(2 + random.below(29), {b.layer(n1, d1), b.layer(n2, d2)}));
            return b.over(1.52);
        }
        case Kind::thick_film:
            film(2000, 20000);
            return b.over(random.below(2) == 0 ? Complex(random.uniform(1, 2.5)) : metal(random));
        case Kind::metal_cavity: {
            const Complex index{random.uniform(0.05, 0.3), random.uniform(2, 4.5)};
            b.add(b.layer(index, random.uniform(10, 60)));
            film(50, 1500);
            b.add(b.layer(index, random.uniform(10, 60)));
            return b.over(1.52);
        }
        case Kind::mirror: {
            const double n1 = random.uniform(1, 1.5), d1 = random.uniform(30, 300);
            const double n2 = random.uniform(1.5, 2.5), d2 = random.uniform(30, 300);
            const auto repeat = static_cast<std::uint64_t>(std::pow(300, random.uniform(0, 1)));
            StackBuilder in_host(n1);
            in_host.add(
                StackBuilder::group(repeat, {in_host.layer(n1, d1), in_host.layer(n2, d2)}));
            return in_host.over(n1);
        }
    }
    return b.over(1);
}

Element incoherent(Element layer) {
    std::get<Layer>(layer.value).coherent = false;
    return layer;
}

Element spread(Element layer, double sigma_nm) {
    std::get<Layer>(layer.value).thickness_sigma_nm = sigma_nm;
    return layer;
}

double random_angle(Random& random) {
    return random.below(5) == 0 ? random.uniform(75, 89) : random.uniform(0, 75);
}

namespace {

void write(const Stack& stack, const std::vector<Element>& elements, std::ostringstream& out) {
    for (const Element& element : elements) {
        if (const Layer* layer = std::get_if<Layer>(&element.value)) {
            const Complex n = index_at(stack.materials[layer->material], 550);
            out << " " << stack.materials[layer->material].name << n << "@" << layer->thickness_nm;
        } else {
            const Group& group = std::get<Group>(element.value);
            out << " (";
            write(stack, group.elements, out);
            out << ")^" << group.repeat;
        }
    }
}

}  // namespace

std::string text_of(const Stack& stack) {
    std::ostringstream out;
    out.precision(17);
    out << index_at(stack.materials[stack.incident], 550).real() << " |";
    write(stack, stack.elements, out);
    const Material& substrate = stack.materials[stack.substrate];
    out << " | " << substrate.name << index_at(substrate, 550);
    return out.str();
}

}  // namespace irido::oracle
