// SPDX-License-Identifier: BSD-3-Clause
// Eight floats in a register of 256 bits: what AVX2 and AVX-512 have in common.
struct Lanes
{
  __m256 Value;

  static Lanes Set(float a) { return { _mm256_set1_ps(a) }; }
  static Lanes Load(const float* p) { return { _mm256_loadu_ps(p) }; }
  void Store(float* p) const { _mm256_storeu_ps(p, this->Value); }
};

inline Lanes operator+(Lanes a, Lanes b)
{
  return { _mm256_add_ps(a.Value, b.Value) };
}
inline Lanes operator-(Lanes a, Lanes b)
{
  return { _mm256_sub_ps(a.Value, b.Value) };
}
inline Lanes operator*(Lanes a, Lanes b)
{
  return { _mm256_mul_ps(a.Value, b.Value) };
}
inline Lanes operator/(Lanes a, Lanes b)
{
  return { _mm256_div_ps(a.Value, b.Value) };
}
/// a b + c
inline Lanes Fma(Lanes a, Lanes b, Lanes c)
{
  return { _mm256_fmadd_ps(a.Value, b.Value, c.Value) };
}
/// c - a b
inline Lanes Fnma(Lanes a, Lanes b, Lanes c)
{
  return { _mm256_fnmadd_ps(a.Value, b.Value, c.Value) };
}
inline Lanes Max(Lanes a, Lanes b)
{
  return { _mm256_max_ps(a.Value, b.Value) };
}
inline Lanes Min(Lanes a, Lanes b)
{
  return { _mm256_min_ps(a.Value, b.Value) };
}
inline Lanes Floor(Lanes a)
{
  return { _mm256_floor_ps(a.Value) };
}
/// values[index] of whole numbers.
inline Lanes Gather(const float* values, Lanes index)
{
  return { _mm256_i32gather_ps(values, _mm256_cvttps_epi32(index.Value), 4) };
}
inline Lanes Sqrt(Lanes a)
{
  return { _mm256_sqrt_ps(a.Value) };
}
inline float Sum(Lanes a)
{
  __m128 s = _mm_add_ps(_mm256_castps256_ps128(a.Value), _mm256_extractf128_ps(a.Value, 1));
  s = _mm_add_ps(s, _mm_movehl_ps(s, s));
  s = _mm_add_ss(s, _mm_shuffle_ps(s, s, 1));
  return _mm_cvtss_f32(s);
}

inline float Largest(Lanes a)
{
  __m128 s = _mm_max_ps(_mm256_castps256_ps128(a.Value), _mm256_extractf128_ps(a.Value, 1));
  s = _mm_max_ps(s, _mm_movehl_ps(s, s));
  s = _mm_max_ss(s, _mm_shuffle_ps(s, s, 1));
  return _mm_cvtss_f32(s);
}
inline void TimesEight(std::uint32_t* values)
{
  auto* p = reinterpret_cast<__m256i*>(values);
  _mm256_store_si256(p, _mm256_slli_epi32(_mm256_load_si256(p), 3));
}

/// Four consecutive floats at Scale times eight indices, turned into four registers.
template <std::size_t Scale, typename Index>
inline void LoadFour(const float* base, const Index* index, Lanes out[4])
{
  const auto pair = [base](Index low, Index high)
  {
    const __m256 a =
      _mm256_castps128_ps256(_mm_load_ps(base + Scale * static_cast<std::size_t>(low)));
    return _mm256_insertf128_ps(a, _mm_load_ps(base + Scale * static_cast<std::size_t>(high)), 1);
  };
  const __m256 r0 = pair(index[0], index[4]);
  const __m256 r1 = pair(index[1], index[5]);
  const __m256 r2 = pair(index[2], index[6]);
  const __m256 r3 = pair(index[3], index[7]);
  const __m256 t0 = _mm256_unpacklo_ps(r0, r1);
  const __m256 t1 = _mm256_unpackhi_ps(r0, r1);
  const __m256 t2 = _mm256_unpacklo_ps(r2, r3);
  const __m256 t3 = _mm256_unpackhi_ps(r2, r3);
  out[0] = { _mm256_shuffle_ps(t0, t2, 0x44) };
  out[1] = { _mm256_shuffle_ps(t0, t2, 0xEE) };
  out[2] = { _mm256_shuffle_ps(t1, t3, 0x44) };
  out[3] = { _mm256_shuffle_ps(t1, t3, 0xEE) };
}

/// Eight vectors of a record's components, turned into the records of eight lanes.
inline void Transpose(const Lanes in[8], __m256 out[8])
{
  __m256 low[4], high[4];
  const auto half = [](const Lanes* v, __m256 r[4])
  {
    const __m256 t0 = _mm256_unpacklo_ps(v[0].Value, v[1].Value);
    const __m256 t1 = _mm256_unpackhi_ps(v[0].Value, v[1].Value);
    const __m256 t2 = _mm256_unpacklo_ps(v[2].Value, v[3].Value);
    const __m256 t3 = _mm256_unpackhi_ps(v[2].Value, v[3].Value);
    r[0] = _mm256_shuffle_ps(t0, t2, 0x44);
    r[1] = _mm256_shuffle_ps(t0, t2, 0xEE);
    r[2] = _mm256_shuffle_ps(t1, t3, 0x44);
    r[3] = _mm256_shuffle_ps(t1, t3, 0xEE);
  };
  half(in, low);
  half(in + 4, high);
  for (int k = 0; k < 4; ++k)
  {
    out[k] = _mm256_permute2f128_ps(low[k], high[k], 0x20);
    out[k + 4] = _mm256_permute2f128_ps(low[k], high[k], 0x31);
  }
}

/// Subtracts lane k of eight components from the eight floats at offsets[k], lane by lane.
inline void SubtractRecords(float* base, const std::uint32_t* offsets, const Lanes components[8])
{
  __m256 rows[8];
  Transpose(components, rows);
  for (int k = 0; k < 8; ++k)
  {
    float* record = base + offsets[k];
    _mm256_store_ps(record, _mm256_sub_ps(_mm256_load_ps(record), rows[k]));
  }
}

/// Adds the sums of the lanes of eight components to one record.
inline void AddSums(float* record, const Lanes components[8])
{
  __m256 r[8];
  Transpose(components, r);
  const __m256 sum =
    _mm256_add_ps(_mm256_add_ps(_mm256_add_ps(r[0], r[4]), _mm256_add_ps(r[2], r[6])),
                  _mm256_add_ps(_mm256_add_ps(r[1], r[5]), _mm256_add_ps(r[3], r[7])));
  _mm256_store_ps(record, _mm256_add_ps(_mm256_load_ps(record), sum));
}

/// Indices of the set bits of a mask, first to last.
struct SetBits
{
  unsigned char Indices[256][8];
  constexpr SetBits() : Indices()
  {
    for (int mask = 0; mask < 256; ++mask)
    {
      int count = 0;
      for (int bit = 0; bit < 8; ++bit)
      {
        if (mask & (1 << bit))
        {
          this->Indices[mask][count++] = static_cast<unsigned char>(bit);
        }
      }
    }
  }
};
constexpr SetBits AllSetBits;

/// Moves the lanes of a mask side by side, to `first` and on, from the last lane to the front.
struct LaneOrder
{
  __m256i Value;

  LaneOrder(unsigned mask, unsigned first)
  {
    static constexpr std::uint32_t Ring[16] = { 0, 1, 2, 3, 4, 5, 6, 7, 0, 1, 2, 3, 4, 5, 6, 7 };
    const auto* indices = reinterpret_cast<const __m128i*>(AllSetBits.Indices[mask]);
    const auto* turn = reinterpret_cast<const __m256i*>(Ring + 8 - first);
    this->Value = _mm256_permutevar8x32_epi32(_mm256_cvtepu8_epi32(_mm_loadl_epi64(indices)),
                                              _mm256_loadu_si256(turn));
  }
  Lanes operator()(Lanes a) const { return { _mm256_permutevar8x32_ps(a.Value, this->Value) }; }
};

/// Eight whole numbers as the bits of lanes.
inline Lanes LoadBits(const std::uint32_t* p)
{
  return { _mm256_castsi256_ps(_mm256_loadu_si256(reinterpret_cast<const __m256i*>(p))) };
}
inline Lanes LoadBits(const std::uint16_t* p)
{
  return { _mm256_castsi256_ps(
    _mm256_cvtepu16_epi32(_mm_loadu_si128(reinterpret_cast<const __m128i*>(p)))) };
}
/// Eight whole numbers one after the other, from the first.
inline Lanes BitsFrom(std::uint32_t first)
{
  return { _mm256_castsi256_ps(_mm256_add_epi32(_mm256_set1_epi32(static_cast<int>(first)),
                                                _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7))) };
}
inline void StoreBits(Lanes a, std::uint32_t* p)
{
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(p), _mm256_castps_si256(a.Value));
}

/// Products summed in double precision.
struct DoubleSum
{
  __m256d Low = _mm256_setzero_pd();
  __m256d High = _mm256_setzero_pd();

  void AddProduct(Lanes a, Lanes b)
  {
    this->Low = _mm256_fmadd_pd(_mm256_cvtps_pd(_mm256_castps256_ps128(a.Value)),
                                _mm256_cvtps_pd(_mm256_castps256_ps128(b.Value)), this->Low);
    this->High = _mm256_fmadd_pd(_mm256_cvtps_pd(_mm256_extractf128_ps(a.Value, 1)),
                                 _mm256_cvtps_pd(_mm256_extractf128_ps(b.Value, 1)), this->High);
  }
  double Total() const
  {
    double v[4];
    _mm256_storeu_pd(v, _mm256_add_pd(this->Low, this->High));
    return (v[0] + v[1]) + (v[2] + v[3]);
  }
};
