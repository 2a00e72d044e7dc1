// SPDX-License-Identifier: BSD-3-Clause
// Eight floats in an AVX2 register.
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
inline Lanes Sqrt(Lanes a)
{
  return { _mm256_sqrt_ps(a.Value) };
}
/// a < b ? yes : no
inline Lanes Less(Lanes a, Lanes b, Lanes yes, Lanes no)
{
  return { _mm256_blendv_ps(no.Value, yes.Value, _mm256_cmp_ps(a.Value, b.Value, _CMP_LT_OQ)) };
}
inline unsigned LessMask(Lanes a, Lanes b)
{
  return static_cast<unsigned>(_mm256_movemask_ps(_mm256_cmp_ps(a.Value, b.Value, _CMP_LT_OQ)));
}
inline float Sum(Lanes a)
{
  __m128 s = _mm_add_ps(_mm256_castps256_ps128(a.Value), _mm256_extractf128_ps(a.Value, 1));
  s = _mm_add_ps(s, _mm_movehl_ps(s, s));
  s = _mm_add_ss(s, _mm_shuffle_ps(s, s, 1));
  return _mm_cvtss_f32(s);
}

/// Four consecutive floats of eight records of eight floats, turned into four registers.
template <typename Index>
inline void LoadFour(const float* base, const Index* index, Lanes out[4])
{
  const auto pair = [base](Index low, Index high)
  {
    const __m256 a = _mm256_castps128_ps256(_mm_load_ps(base + 8 * static_cast<std::size_t>(low)));
    return _mm256_insertf128_ps(a, _mm_load_ps(base + 8 * static_cast<std::size_t>(high)), 1);
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
