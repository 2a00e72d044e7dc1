// SPDX-License-Identifier: BSD-3-Clause
#include "Base/Primitives.h"
#include "Base/Random.h"
#include "Base/ShapeMeasures.h"
#include "Base/TemporaryFolder.h"
#include "Export/GltfAnimation.h"
#include "Export/LoadedGlb.h"

#include <gtest/gtest.h>

#include <tiny_gltf.h>

#include <algorithm>
#include <filesystem>

using namespace waft;

namespace
{

waft::SilentMonitor monitor;
// A PNG of one pixel.
const unsigned char Pixel[] = { 0x89, 'P', 'N', 'G', 0x0d, 0x0a, 0x1a, 0x0a, 0,    0,    0,    0x0d,
                                'I',  'H', 'D', 'R', 0,    0,    0,    1,    0,    0,    0,    1,
                                8,    6,   0,   0,   0,    0x1f, 0x15, 0xc4, 0x89, 0,    0,    0,
                                0x0d, 'I', 'D', 'A', 'T',  0x78, 0x9c, 0x63, 0xf8, 0xcf, 0xc0, 0xf0,
                                0x1f, 0,   5,   0,   1,    0xff, 0x89, 0x99, 0x3d, 0x1d, 0,    0,
                                0,    0,   'I', 'E', 'N',  'D',  0xae, 0x42, 0x60, 0x82 };

std::vector<AnimatedShape> Shapes()
{
  std::vector<AnimatedShape> shapes(2);
  shapes[0].Body.Name = "box";
  shapes[0].Body.Mesh = MakeBox({ Vec3(-1.0, -2.0, -3.0), Vec3(1.0, 2.0, 3.0) });
  shapes[0].Body.Color = { 0.25, 0.5, 0.75 };
  shapes[1].Body.Name = "ball";
  shapes[1].Body.Mesh = MakeSphere(Vec3::Zero(), 0.1, 8, 6);
  shapes[1].Body.Color = { 0.8, 0.6, 0.1 };
  shapes[1].Body.TextureCoordinates.assign(shapes[1].Body.Mesh.Points.size(), { 0.25, 0.125 });
  shapes[1].Texture = { std::string(reinterpret_cast<const char*>(Pixel), sizeof(Pixel)),
                        "image/png" };
  return shapes;
}

std::vector<AnimatedObject> Objects()
{
  Random random(5);
  std::vector<AnimatedObject> objects(3);
  for (int i = 0; i < 3; ++i)
  {
    objects[i].ObjectId = 10 * i;
    objects[i].Shape = static_cast<std::size_t>(i % 2);
    for (int k = 0; k < 7; ++k)
    {
      objects[i].Positions.push_back(4.0 * random.Direction());
      const Vec3 axis = random.Direction();
      objects[i].Orientations.emplace_back(Eigen::AngleAxisd(random.Uniform(), axis));
    }
  }
  return objects;
}

const float* Floats(const tinygltf::Model& model, int accessor)
{
  const tinygltf::BufferView& view = model.bufferViews[model.accessors[accessor].bufferView];
  return reinterpret_cast<const float*>(model.buffers[view.buffer].data.data() + view.byteOffset);
}

void WriteAndRead(const std::vector<AnimatedShape>& shapes,
                  const std::vector<AnimatedObject>& objects, double rate, tinygltf::Model& model)
{
  std::string bytes;
  ASSERT_TRUE(GltfAnimation(shapes, objects, rate, bytes, monitor));
  ASSERT_NO_FATAL_FAILURE(LoadGlb(bytes, model));
}
} // namespace

TEST(GltfAnimation, PosesReadBackWithYUp)
{
  const std::vector<AnimatedObject> objects = Objects();
  tinygltf::Model model;
  ASSERT_NO_FATAL_FAILURE(WriteAndRead(Shapes(), objects, 24.0, model));
  ASSERT_EQ(model.meshes.size(), 2u);
  ASSERT_EQ(model.nodes.size(), 3u);
  ASSERT_EQ(model.animations.size(), 1u);
  ASSERT_EQ(model.images.size(), 1u);
  EXPECT_EQ(model.images[0].width, 1);
  const Quat toYUp(Eigen::AngleAxisd(-0.5 * std::acos(-1.0), Vec3::UnitX()));
  int times = -1;
  for (const tinygltf::AnimationChannel& channel : model.animations[0].channels)
  {
    const tinygltf::AnimationSampler& sampler = model.animations[0].samplers[channel.sampler];
    const AnimatedObject& object = objects[channel.target_node];
    EXPECT_TRUE(times < 0 || times == sampler.input);
    times = sampler.input;
    for (int k = 0; k < 7; ++k)
    {
      EXPECT_NEAR(Floats(model, sampler.input)[k], k / 24.0, 1e-6);
      if (channel.target_path == "translation")
      {
        const float* v = Floats(model, sampler.output) + 3 * k;
        EXPECT_LT((Vec3(v[0], v[1], v[2]) - toYUp * object.Positions[k]).norm(), 1e-5);
      }
      else
      {
        ASSERT_EQ(channel.target_path, "rotation");
        const float* v = Floats(model, sampler.output) + 4 * k;
        const Quat expected = toYUp * object.Orientations[k] * toYUp.conjugate();
        EXPECT_LT((Quat(v[3], v[0], v[1], v[2]).coeffs() - expected.coeffs()).norm(), 1e-6);
      }
    }
  }
  const tinygltf::Primitive& ball = model.meshes[1].primitives[0];
  EXPECT_FLOAT_EQ(Floats(model, ball.attributes.at("TEXCOORD_0"))[1], 0.875F);
  const tinygltf::Accessor& box =
    model.accessors[model.meshes[0].primitives[0].attributes.at("POSITION")];
  EXPECT_EQ(box.maxValues, (std::vector<double>{ 1.0, 3.0, 2.0 }));
}

namespace
{

void ExpectFactor(const tinygltf::Material& material, const std::vector<double>& expected)
{
  const std::vector<double>& factor = material.pbrMetallicRoughness.baseColorFactor;
  ASSERT_EQ(factor.size(), expected.size());
  for (std::size_t c = 0; c < expected.size(); ++c)
  {
    EXPECT_NEAR(factor[c], expected[c], 1e-6);
  }
}

} // namespace

TEST(GltfAnimation, MaterialsAreWhiteUnderATextureAndColouredWithout)
{
  tinygltf::Model model;
  ASSERT_NO_FATAL_FAILURE(WriteAndRead(Shapes(), Objects(), 24.0, model));
  ASSERT_EQ(model.materials.size(), 2u);
  const tinygltf::Material& plain = model.materials[model.meshes[0].primitives[0].material];
  ExpectFactor(plain, { 0.050876, 0.214041, 0.522522, 1.0 }); // of 0.25, 0.5, 0.75
  EXPECT_EQ(plain.pbrMetallicRoughness.baseColorTexture.index, -1);
  EXPECT_EQ(plain.alphaMode, "OPAQUE");
  EXPECT_TRUE(plain.doubleSided);
  const tinygltf::Material& painted = model.materials[model.meshes[1].primitives[0].material];
  EXPECT_EQ(painted.pbrMetallicRoughness.baseColorFactor,
            (std::vector<double>{ 1.0, 1.0, 1.0, 1.0 }));
  EXPECT_EQ(painted.pbrMetallicRoughness.baseColorTexture.index, 0);
  EXPECT_EQ(painted.alphaMode, "MASK");
  EXPECT_EQ(painted.alphaCutoff, 0.5);
  EXPECT_TRUE(painted.doubleSided);
}

TEST(GltfAnimation, AFilmLetsLightThrough)
{
  std::vector<AnimatedShape> shapes = Shapes();
  shapes[0].Body.Mesh = MakeBox({ Vec3(0.0, 0.0, 0.0), Vec3(1.0, 1.0, 1.0) });
  shapes[0].Normals.clear();
  shapes[0].Body.TextureCoordinates.clear();
  shapes[0].Body.AreaDensity = 0.002;
  tinygltf::Model model;
  ASSERT_NO_FATAL_FAILURE(WriteAndRead(shapes, Objects(), 24.0, model));
  EXPECT_EQ(model.materials[0].alphaMode, "BLEND");
  EXPECT_NEAR(model.materials[0].pbrMetallicRoughness.baseColorFactor[3], Opacity(shapes[0].Body),
              1e-6);
  EXPECT_LT(model.materials[0].pbrMetallicRoughness.baseColorFactor[3], 0.5);
  EXPECT_NE(model.materials[1].alphaMode, "BLEND");
}

TEST(GltfAnimation, TheTintIsTheFactorOfTheTexture)
{
  std::vector<AnimatedShape> shapes = Shapes();
  shapes[0].Body.Tint = { 0.8, 0.6, 0.1 }; // no texture: nothing to tint
  shapes[1].Body.Tint = { 0.25, 0.5, 0.75 };
  tinygltf::Model model;
  ASSERT_NO_FATAL_FAILURE(WriteAndRead(shapes, Objects(), 24.0, model));
  ExpectFactor(model.materials[model.meshes[0].primitives[0].material],
               { 0.050876, 0.214041, 0.522522, 1.0 }); // of its colour, 0.25, 0.5, 0.75
  const tinygltf::Material& painted = model.materials[model.meshes[1].primitives[0].material];
  ExpectFactor(painted, { 0.050876, 0.214041, 0.522522, 1.0 });
  EXPECT_EQ(painted.pbrMetallicRoughness.baseColorTexture.index, 0);
}

TEST(GltfAnimation, ATextureWithoutCoordinatesLeavesTheColour)
{
  std::vector<AnimatedShape> shapes = Shapes();
  shapes[1].Body.TextureCoordinates.clear();
  tinygltf::Model model;
  ASSERT_NO_FATAL_FAILURE(WriteAndRead(shapes, Objects(), 24.0, model));
  const tinygltf::Material& material = model.materials[model.meshes[1].primitives[0].material];
  ExpectFactor(material, { 0.603827, 0.318547, 0.010023, 1.0 }); // of 0.8, 0.6, 0.1
  EXPECT_EQ(material.pbrMetallicRoughness.baseColorTexture.index, -1);
  EXPECT_TRUE(model.textures.empty());
}

TEST(GltfAnimation, NodesTellShapeAndObjectAndTheFileItsRate)
{
  const double rate = 24000.0 / 1001.0;
  std::vector<AnimatedShape> shapes = Shapes();
  shapes[1].Body.Name.clear();
  tinygltf::Model model;
  ASSERT_NO_FATAL_FAILURE(WriteAndRead(shapes, Objects(), rate, model));
  const char* names[] = { "box-0", "object-10", "box-20" };
  for (int i = 0; i < 3; ++i)
  {
    EXPECT_EQ(model.nodes[i].name, names[i]);
    EXPECT_EQ(model.nodes[i].extras.Get("ObjectId").Get<int>(), 10 * i);
  }
  EXPECT_EQ(model.asset.extras.Get("framesPerSecond").Get<double>(), rate);
  const tinygltf::AnimationSampler& sampler = model.animations[0].samplers[0];
  for (int k = 0; k < 7; ++k)
  {
    EXPECT_EQ(Floats(model, sampler.input)[k], static_cast<float>(k / rate));
  }
}

TEST(GltfAnimation, FarFromTheOriginPlacesAreRelativeToTheCornerOfTheVolume)
{
  const Vec3 far(447000.0, 812000.0, 120.0);
  const Box volume{ far - Vec3::Constant(5.0), far + Vec3::Constant(5.0) };
  std::vector<AnimatedObject> objects = Objects();
  for (AnimatedObject& object : objects)
  {
    for (Vec3& place : object.Positions)
    {
      place += far;
    }
  }
  for (const std::size_t mostWholeKeys : { AnyNumberOfKeys, std::size_t(0) })
  {
    std::string bytes;
    tinygltf::Model model;
    ASSERT_TRUE(GltfAnimation(Shapes(), objects, 24.0, bytes, monitor, mostWholeKeys, volume));
    ASSERT_NO_FATAL_FAILURE(LoadGlb(bytes, model));
    ASSERT_EQ(model.scenes[0].nodes, std::vector<int>{ 3 });
    const tinygltf::Node& root = model.nodes[3];
    EXPECT_EQ(root.children, (std::vector<int>{ 0, 1, 2 }));
    EXPECT_EQ(root.translation, (std::vector<double>{ 446995.0, 115.0, -811995.0 }));
    for (const tinygltf::AnimationChannel& channel : model.animations[0].channels)
    {
      const std::vector<Vec3>& wanted = objects[channel.target_node].Positions;
      const tinygltf::Accessor& keys =
        model.accessors[model.animations[0].samplers[channel.sampler].output];
      for (int k = 0; channel.target_path == "translation" && k < 7; ++k)
      {
        const auto* at = reinterpret_cast<const float*>(
          model.buffers[0].data.data() + model.bufferViews[keys.bufferView].byteOffset +
          keys.byteOffset);
        const Vec3 v(at[3 * k], at[3 * k + 1], at[3 * k + 2]);
        EXPECT_LT((Vec3(v.x(), -v.z(), v.y()) + volume.Min - wanted[k]).norm(), 2e-6);
      }
      const std::vector<double>& first = model.nodes[channel.target_node].translation;
      EXPECT_LT((Vec3(first[0], -first[2], first[1]) + volume.Min - wanted[0]).norm(), 1e-9);
    }
  }
}

TEST(GltfAnimation, BadDataAreNamedAndNothingIsWritten)
{
  const test::TemporaryFolder folder;
  const std::string path = folder.File("animation.glb");
  const auto message = [&](const std::vector<AnimatedObject>& objects)
  {
    const Result result = WriteAnimationGlb(path, Shapes(), objects, 30.0, monitor);
    EXPECT_FALSE(result);
    EXPECT_FALSE(std::filesystem::exists(path));
    return result.Message();
  };
  std::vector<AnimatedObject> objects = Objects();
  objects[2].Shape = 2;
  EXPECT_NE(message(objects).find("object 20: shape 2"), std::string::npos);
  objects = Objects();
  objects[1].Positions.pop_back();
  EXPECT_NE(message(objects).find("object 10"), std::string::npos);
  objects = Objects();
  objects[0].Positions[4].x() = std::nan("");
  EXPECT_NE(message(objects).find("frame 4"), std::string::npos);
  ASSERT_TRUE(WriteAnimationGlb(path, Shapes(), Objects(), 30.0, monitor));
  EXPECT_TRUE(std::filesystem::remove(path));
}

TEST(ImageFile, OnlyImagesAreTaken)
{
  ImageFile image;
  EXPECT_FALSE(ReadImageFile("/no/such/image.png", image));
  EXPECT_FALSE(ReadImageFile(__FILE__, image));
}

TEST(GltfAnimation, WhoComesIntoTheShotIsNothingBefore)
{
  std::vector<AnimatedObject> objects = Objects();
  objects[1].Sizes.assign(objects[1].Positions.size(), 1.0F);
  std::fill_n(objects[1].Sizes.begin(), 4, 0.0F);
  tinygltf::Model model;
  ASSERT_NO_FATAL_FAILURE(WriteAndRead(Shapes(), objects, 2.0, model));
  const tinygltf::Animation& animation = model.animations[0];
  ASSERT_EQ(7u, animation.channels.size()); // two an object, and one
  for (const tinygltf::AnimationChannel& channel : animation.channels)
  {
    const tinygltf::AnimationSampler& sampler =
      animation.samplers[static_cast<std::size_t>(channel.sampler)];
    if (channel.target_path != "scale")
    {
      EXPECT_EQ("LINEAR", sampler.interpolation);
      continue;
    }
    EXPECT_EQ(1, channel.target_node);
    EXPECT_EQ("STEP", sampler.interpolation);
    const float* times = Floats(model, sampler.input);
    const float* scales = Floats(model, sampler.output);
    EXPECT_EQ(0.0F, times[0]);
    EXPECT_EQ(2.0F, times[1]);
    for (int c = 0; c < 3; ++c)
    {
      EXPECT_EQ(0.0F, scales[c]);
      EXPECT_EQ(1.0F, scales[3 + c]);
    }
  }
}
