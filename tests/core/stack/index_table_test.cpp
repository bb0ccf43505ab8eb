#include "core/stack/index_table.hpp"

#include <array>
#include <catch2/catch.hpp>

#include "core/material/library.hpp"
#include "core/stack/builder.hpp"

using namespace irido;

namespace {

void check_same(const IndexTable& a, const IndexTable& b) {
    CHECK(a.wavelength_nm() == b.wavelength_nm());
    for (std::size_t w = 0; w < a.wavelength_nm().size(); ++w) {
        CHECK(a.k0()[w] == b.k0()[w]);
        for (std::size_t m = 0; m < a.materials(); ++m) CHECK(a.index(m, w) == b.index(m, w));
    }
    for (std::size_t m = 0; m < a.materials(); ++m) CHECK(a.is_constant(m) == b.is_constant(m));
    CHECK(a.absorbs() == b.absorbs());
    CHECK(a.amplifies() == b.amplifies());
    CHECK(a.incident() == b.incident());
    double largest = 0;
    for (std::size_t w = 0; w < a.wavelength_nm().size(); ++w)
        for (std::size_t m = 0; m < a.materials(); ++m)
            largest = std::max(largest, a.k0()[w] * std::abs(a.index(m, w)));
    CHECK(a.largest_wavenumber() >= largest * (1 - 1e-15));
    CHECK(a.largest_wavenumber() <= largest * 4);
}

}  // namespace

TEST_CASE("tables of the same stack are put together") {
    StackBuilder b;
    const std::size_t metal = b.material(find_material("Cu")->material);
    b.add(b.layer(1.5, 300));
    const Stack stack = b.over_material(metal);
    const IndexTable red(stack, {700, 650}), blue(stack, {400}), green(stack, {555, 510, 540});
    const std::array<const IndexTable*, 3> parts{&red, &blue, &green};
    IndexTable all(stack, {500, 501, 502, 503, 504, 505, 506, 507, 508});
    all.assign(parts);
    check_same(all, IndexTable(stack, {700, 650, 400, 555, 510, 540}));
}

TEST_CASE("constant indices are taken to other wavelengths") {
    StackBuilder b;
    b.add(b.layer({1.7, 0.02}, 300));
    const Stack stack = b.over({2.1, -0.1});
    const std::vector<double> some{700, 380}, more{420, 555.5};
    const std::array<const std::vector<double>*, 2> parts{&some, &more};
    const IndexTable model(stack, {500});
    IndexTable all = model;
    all.assign(model, parts);
    check_same(all, IndexTable(stack, {700, 380, 420, 555.5}));
}

TEST_CASE("one material's indices are replaced") {
    StackBuilder b;
    b.add(b.layer(1.7, 300));
    const Stack stack = b.over({2.1, 0.1});
    StackBuilder c;
    c.add(c.layer({1.8, 0.3}, 300));
    IndexTable table(stack, {700, 380}), other(c.over({2.1, 0.1}), {700, 380});
    const std::size_t film = std::get<Layer>(stack.elements[0].value).material;
    table.replace(film, std::vector<Complex>{{1.8, 0.3}, {1.8, 0.3}});
    check_same(table, other);
    table.replace(film, std::vector<Complex>{{1.8, 0}, {9, -0.3}});
    CHECK_FALSE(table.is_constant(film));
    CHECK(table.amplifies()[film]);
    CHECK(table.largest_wavenumber() >= table.k0()[1] * 9);
}
