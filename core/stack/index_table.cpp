#include "core/stack/index_table.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/error.hpp"
#include "core/math/simd_level.hpp"

namespace irido {

namespace {

/// See IndexTable::extraordinary().
std::vector<std::size_t> rows_of_extraordinary(const std::vector<Material>& materials) {
    std::vector<std::size_t> rows;
    rows.reserve(materials.size());
    std::size_t next = materials.size();
    for (std::size_t m = 0; m < materials.size(); ++m)
        rows.push_back(is_uniaxial(materials[m]) ? next++ : m);
    return rows;
}

}  // namespace

IndexTable::IndexTable(const Stack& stack, std::vector<double> wavelength_nm)
    : wavelength_nm_(std::move(wavelength_nm)),
      materials_(stack.materials.size()),
      incident_(stack.incident),
      extraordinary_(rows_of_extraordinary(stack.materials)),
      k0_(wavelength_nm_.size() + kMostLanes, 1),
      absorbs_(materials_, false),
      amplifies_(materials_, false) {
    const std::size_t count = wavelength_nm_.size();
    double largest_k0 = 0, largest_index = 0;
    for (std::size_t w = 0; w < count; ++w) {
        require_in_range("wavelength_nm", wavelength_nm_[w], kAllWavelengths.first_nm,
                         kAllWavelengths.last_nm);
        k0_[w] = 2 * std::numbers::pi / wavelength_nm_[w];
        largest_k0 = std::max(largest_k0, k0_[w]);
    }
    const auto fill = [&](std::size_t m, auto&& at) {
        const Material& material = stack.materials[m];
        rows_.push_back(new_row(1));
        const bool varies = !irido::is_constant(material);
        for (std::size_t w = 0; w < (varies ? count : std::min<std::size_t>(count, 1)); ++w) {
            const Complex index = at(material, wavelength_nm_[w]);
            largest_index =
                std::max(largest_index, std::abs(index.real()) + std::abs(index.imag()));
            set(rows_.size() - 1, w, index);
            note_sign(m, index);
        }
    };
    rows_.reserve(materials_);
    n_.reserve(materials_ + kMostLanes);
    k_.reserve(materials_ + kMostLanes);
    clear_rows();
    for (std::size_t m = 0; m < materials_; ++m) fill(m, index_at);
    for (std::size_t m = 0; m < materials_; ++m)
        if (extraordinary_[m] != m) fill(m, extraordinary_index_at);
    largest_wavenumber_ = largest_k0 * largest_index;
    for (std::size_t w = 0; w < count; ++w) {
        const Complex incident = index(incident_, w);
        if (incident.real() > 0 && std::abs(incident.imag()) < kTransparentBelow_k) continue;
        throw DomainError("the incident medium must be transparent, |k| below 1e-3 (got n = " +
                          to_text(incident.real()) + ", k = " + to_text(incident.imag()) + " at " +
                          to_text(wavelength_nm_[w]) + " nm)");
    }
}

void IndexTable::clear_rows() {
    rows_.clear();
    n_.assign(kMostLanes, 1);
    k_.assign(kMostLanes, 0);
}

/// A row of `places` values, before the padding.
IndexTable::Row IndexTable::new_row(std::size_t places) {
    const std::size_t first = n_.size() - kMostLanes;
    n_.resize(n_.size() + places, 1);
    k_.resize(n_.size(), 0);
    return {first, places > 1};
}

/// Values of a row must be set in the order of their wavelengths: the first one serves for all of
/// them until another differs.
void IndexTable::set(std::size_t row, std::size_t wavelength, Complex index) {
    if (wavelength > 0 && !rows_[row].varies) {
        const Complex first = this->index(row, 0);
        if (index == first) return;
        const std::size_t count = wavelength_nm_.size();
        rows_[row] = new_row(count);
        std::fill_n(n_.data() + rows_[row].first, count, first.real());
        std::fill_n(k_.data() + rows_[row].first, count, first.imag());
    }
    n_[rows_[row].at(wavelength)] = index.real();
    k_[rows_[row].at(wavelength)] = index.imag();
}

void IndexTable::note_sign(std::size_t material, Complex index) {
    if (index.imag() != 0) absorbs_[material] = true;
    if (index.imag() < 0) amplifies_[material] = true;
}

void IndexTable::replace(std::size_t material, std::span<const Complex> index) {
    for (std::size_t w = 0; w < wavelength_nm_.size(); ++w) {
        set(material, w, index[w]);
        note_sign(material, index[w]);
        largest_wavenumber_ = std::max(
            largest_wavenumber_, k0_[w] * (std::abs(index[w].real()) + std::abs(index[w].imag())));
    }
}

void IndexTable::resize_like(const IndexTable& model, std::size_t count) {
    materials_ = model.materials_;
    extraordinary_ = model.extraordinary_;
    incident_ = model.incident_;
    largest_wavenumber_ = 0;
    absorbs_ = model.absorbs_;
    amplifies_ = model.amplifies_;
    wavelength_nm_.resize(count);
    k0_.resize(count + kMostLanes, 1);
}

void IndexTable::assign(const IndexTable& constant,
                        std::span<const std::vector<double>* const> wavelengths) {
    std::size_t count = 0;
    for (const std::vector<double>* some : wavelengths) count += some->size();
    resize_like(constant, count);
    std::size_t at = 0;
    double shortest = std::numeric_limits<double>::infinity();
    for (const std::vector<double>* some : wavelengths) {
        for (const double wavelength : *some) {
            wavelength_nm_[at] = wavelength;
            k0_[at++] = 2 * std::numbers::pi / wavelength;
            shortest = std::min(shortest, wavelength);
        }
    }
    rows_ = constant.rows_;
    n_ = constant.n_;
    k_ = constant.k_;
    largest_wavenumber_ = constant.largest_wavenumber_ * constant.wavelength_nm_[0] / shortest;
}

void IndexTable::assign(std::span<const IndexTable* const> parts) {
    const IndexTable& first = *parts.front();
    std::size_t count = 0;
    for (const IndexTable* part : parts) count += part->wavelength_nm_.size();
    resize_like(first, count);
    std::size_t at = 0;
    for (const IndexTable* part : parts) {
        const std::size_t some = part->wavelength_nm_.size();
        std::copy_n(part->wavelength_nm_.data(), some, wavelength_nm_.data() + at);
        std::copy_n(part->k0_.data(), some, k0_.data() + at);
        for (std::size_t m = 0; m < materials_; ++m) {
            if (part->absorbs_[m]) absorbs_[m] = true;
            if (part->amplifies_[m]) amplifies_[m] = true;
        }
        largest_wavenumber_ = std::max(largest_wavenumber_, part->largest_wavenumber_);
        at += some;
    }
    clear_rows();
    for (std::size_t row = 0; row < first.rows_.size(); ++row) {
        rows_.push_back(new_row(1));
        at = 0;
        for (const IndexTable* part : parts) {
            const std::size_t some = part->wavelength_nm_.size();
            const bool is_same = at > 0 && !rows_[row].varies && !part->rows_[row].varies &&
                                 part->index(row, 0) == index(row, 0);
            for (std::size_t w = 0; w < some && !is_same; ++w)
                set(row, at + w, part->index(row, w));
            at += some;
        }
    }
}

}  // namespace irido
