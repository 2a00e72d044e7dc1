// SPDX-License-Identifier: BSD-3-Clause
#include "Export/GltfAnimation.h"

#include "Base/FractionDone.h"

#include "Base/AtomicFile.h"
#include "Base/MeshNormals.h"
#include "Base/ShapeMeasures.h"
#include "Export/Appender.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <ostream>
#include <utility>

namespace waft
{
namespace
{
/// Numbers of one accessor, `Width` to an element.
template <typename T>
struct Elements
{
  std::vector<T> Values;
  int Type = TINYGLTF_TYPE_SCALAR;
  std::size_t Width = 1;
};

constexpr std::size_t NumbersOfPose = BodyKeys::PlaceWidth + BodyKeys::TurnWidth;

Elements<float> Vectors(const std::vector<Vec3>& vectors)
{
  Elements<float> elements{ {}, TINYGLTF_TYPE_VEC3, 3 };
  for (const Vec3& vector : vectors)
  {
    const Vec3 v = ToYUp(vector);
    for (int i = 0; i < 3; ++i)
    {
      elements.Values.push_back(static_cast<float>(v[i]));
    }
  }
  return elements;
}

tinygltf::Value Extras(const std::string& name, tinygltf::Value value)
{
  return tinygltf::Value(tinygltf::Value::Object{ { name, std::move(value) } });
}

/// The factor is an amount of light; a scene's colour is what a screen is told (sRGB).
double Linear(double value)
{
  return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
}

class Writer
{
public:
  Writer(double framesPerSecond, const Box& volume) :
    FramesPerSecond(framesPerSecond), Origin(KeyOrigin(volume))
  {
    this->Model.asset.version = "2.0";
    this->Model.asset.generator = "Waft";
    this->Model.asset.extras = Extras("framesPerSecond", tinygltf::Value(framesPerSecond));
    this->Model.buffers.emplace_back();
    this->Model.scenes.emplace_back();
    this->Model.defaultScene = 0;
  }

  void AddShape(const AnimatedShape& shape)
  {
    tinygltf::Primitive primitive;
    primitive.mode = TINYGLTF_MODE_TRIANGLES;
    primitive.attributes["POSITION"] =
      this->AddAccessor(Vectors(shape.Body.Mesh.Points), TINYGLTF_TARGET_ARRAY_BUFFER);
    primitive.attributes["NORMAL"] =
      this->AddAccessor(Vectors(shape.Normals), TINYGLTF_TARGET_ARRAY_BUFFER);
    if (!shape.Body.TextureCoordinates.empty())
    {
      Elements<float> coordinates{ {}, TINYGLTF_TYPE_VEC2, 2 };
      for (const auto& uv : shape.Body.TextureCoordinates)
      {
        coordinates.Values.push_back(static_cast<float>(uv[0]));
        coordinates.Values.push_back(static_cast<float>(1.0 - uv[1])); // rows from the top
      }
      primitive.attributes["TEXCOORD_0"] =
        this->AddAccessor(coordinates, TINYGLTF_TARGET_ARRAY_BUFFER);
    }
    Elements<std::uint32_t> corners;
    for (const auto& triangle : shape.Body.Mesh.Triangles)
    {
      for (const int corner : triangle)
      {
        corners.Values.push_back(static_cast<std::uint32_t>(corner));
      }
    }
    primitive.indices = this->AddAccessor(corners, TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER);
    primitive.material = this->AddMaterial(shape);
    tinygltf::Mesh mesh;
    mesh.name = shape.Body.Name;
    mesh.primitives.push_back(primitive);
    this->Model.meshes.push_back(mesh);
  }

  /// For the poses of so many objects: bytes that grow are there twice.
  void BeginMotion(std::size_t objects, std::size_t frames, bool isThinned)
  {
    this->Model.animations.emplace_back();
    this->Model.animations[0].name = "Motion";
    this->Poses = objects * frames;
    this->Frames = frames;
    std::vector<unsigned char>& data = this->Model.buffers[0].data;
    data.reserve(data.size() + (frames + this->Poses * NumbersOfPose) * sizeof(float));
    if (isThinned) // thousands of short accessors, in a view of their own together
    {
      this->KeysView = this->AddView(nullptr, 0, 0);
    }
  }

  /// Of each object before the first one is added, where keys are thinned.
  void Announce(const AnimatedObject& object)
  {
    this->Keys.Add(KeysOf(object, this->FramesPerSecond, this->Origin), object.Marks);
  }

  void AddObject(const AnimatedObject& object, double placeTolerance)
  {
    tinygltf::Node node;
    const std::string& shape = this->Model.meshes[object.Shape].name;
    node.name = (shape.empty() ? "object" : shape) + "-" + std::to_string(object.ObjectId);
    node.extras = Extras("ObjectId", tinygltf::Value(object.ObjectId));
    if (object.LoopTo >= 0)
    {
      node.extras.Get<tinygltf::Value::Object>()["LoopTo"] = tinygltf::Value(object.LoopTo);
    }
    node.mesh = static_cast<int>(object.Shape);
    const Vec3 translation = ToYUp(object.Positions[0] - this->Origin);
    const Vec3 axis = ToYUp(object.Orientations[0].vec());
    node.translation = { translation.x(), translation.y(), translation.z() };
    node.rotation = { axis.x(), axis.y(), axis.z(), object.Orientations[0].w() };
    const int number = static_cast<int>(this->Model.nodes.size());
    this->Model.nodes.push_back(node);
    this->Model.scenes[0].nodes.push_back(number);

    BodyKeys keys = KeysOf(object, this->FramesPerSecond, this->Origin);
    const int times = this->TimesOf(object, placeTolerance, keys);
    this->Kept += keys.Count();
    Elements<float> places{ std::move(keys.Places), TINYGLTF_TYPE_VEC3, BodyKeys::PlaceWidth };
    Elements<float> turns{ std::move(keys.Turns), TINYGLTF_TYPE_VEC4, BodyKeys::TurnWidth };
    this->AddChannel(number, "translation", times, this->AddAccessor(places, 0));
    this->AddChannel(number, "rotation", times, this->AddAccessor(turns, 0));
    if (!object.Sizes.empty())
    {
      this->AddSizes(number, object);
    }
  }

  bool Save(std::string& bytes)
  {
    if (this->KeysView >= 0)
    {
      this->SayHowThinned();
    }
    if (!this->Model.nodes.empty() && !this->Origin.isZero(0.0))
    {
      this->AddRoot();
    }
    bytes.clear();
    bytes.reserve(this->Model.buffers[0].data.size());
    Appender appender(bytes);
    std::ostream stream(&appender);
    tinygltf::TinyGLTF gltf;
    return gltf.WriteGltfSceneToStream(&this->Model, stream, false, true) && stream.good();
  }

private:
  /// Above all objects, where their places are relative to the corner of the volume.
  void AddRoot()
  {
    tinygltf::Node root;
    root.name = "volume";
    const Vec3 corner = ToYUp(this->Origin);
    root.translation = { corner.x(), corner.y(), corner.z() };
    root.children.swap(this->Model.scenes[0].nodes);
    this->Model.scenes[0].nodes.push_back(static_cast<int>(this->Model.nodes.size()));
    this->Model.nodes.push_back(root);
  }

  /// Leaves out keys of an object that can be; returns the accessor of the times of the others,
  /// which objects share.
  int TimesOf(const AnimatedObject& object, double placeTolerance, BodyKeys& keys)
  {
    const double turnTolerance = KeyTurnTolerance * std::acos(-1.0) / 180.0;
    const std::size_t list =
      this->KeysView >= 0 ? this->Keys.Thin(object.Marks, placeTolerance, turnTolerance, keys) : 0;
    if (list == this->Times.size())
    {
      this->Times.push_back(this->AddAccessor(Elements<float>{ keys.Times }, 0));
    }
    return this->Times[list];
  }

  void SayHowThinned()
  {
    const auto number = [](std::size_t count) { return tinygltf::Value(static_cast<int>(count)); };
    this->Model.asset.extras.Get<tinygltf::Value::Object>()["keys"] = tinygltf::Value(
      tinygltf::Value::Object{ { "kept", number(this->Kept) },
                               { "of", number(this->Poses) },
                               { "frames", number(this->Frames) },
                               { "placeTolerance", tinygltf::Value(KeyPlaceTolerance) },
                               { "turnTolerance", tinygltf::Value(KeyTurnTolerance) } });
  }

  std::size_t Append(const void* bytes, std::size_t size)
  {
    std::vector<unsigned char>& data = this->Model.buffers[0].data;
    const std::size_t at = data.size();
    data.resize(at + size);
    if (size > 0)
    {
      std::memcpy(data.data() + at, bytes, size);
    }
    return at;
  }

  int AddView(const void* bytes, std::size_t size, int target)
  {
    std::vector<unsigned char>& data = this->Model.buffers[0].data;
    data.resize((data.size() + 3) / 4 * 4, 0); // accessors begin at multiples of four
    tinygltf::BufferView view;
    view.buffer = 0;
    view.byteOffset = this->Append(bytes, size);
    view.byteLength = size;
    view.target = target;
    this->Model.bufferViews.push_back(view);
    return static_cast<int>(this->Model.bufferViews.size()) - 1;
  }

  template <typename T>
  int AddAccessor(const Elements<T>& elements, int target)
  {
    tinygltf::Accessor accessor;
    const std::size_t size = elements.Values.size() * sizeof(T);
    if (this->KeysView >= 0)
    {
      tinygltf::BufferView& view = this->Model.bufferViews[this->KeysView];
      accessor.bufferView = this->KeysView;
      accessor.byteOffset = view.byteLength;
      this->Append(elements.Values.data(), size);
      view.byteLength += size;
    }
    else
    {
      accessor.bufferView = this->AddView(elements.Values.data(), size, target);
    }
    accessor.componentType = sizeof(T) == sizeof(float) && std::is_floating_point<T>::value
                               ? TINYGLTF_COMPONENT_TYPE_FLOAT
                               : TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
    accessor.type = elements.Type;
    accessor.count = elements.Values.size() / elements.Width;
    // Readers ask for the ends of points and times; of thousands of lists of keys they are as long.
    const std::size_t ranged =
      this->KeysView < 0 || elements.Type == TINYGLTF_TYPE_SCALAR ? elements.Width : 0;
    for (std::size_t c = 0; c < ranged; ++c)
    {
      T low = elements.Values[c];
      T high = low;
      for (std::size_t i = c; i < elements.Values.size(); i += elements.Width)
      {
        low = std::min(low, elements.Values[i]);
        high = std::max(high, elements.Values[i]);
      }
      accessor.minValues.push_back(static_cast<double>(low));
      accessor.maxValues.push_back(static_cast<double>(high));
    }
    this->Model.accessors.push_back(accessor);
    return static_cast<int>(this->Model.accessors.size()) - 1;
  }

  /// A key where the size becomes another.
  void AddSizes(int node, const AnimatedObject& object)
  {
    Elements<float> times;
    Elements<float> sizes{ {}, TINYGLTF_TYPE_VEC3, 3 };
    for (std::size_t k = 0; k < object.Sizes.size(); ++k)
    {
      if (k == 0 || object.Sizes[k] != object.Sizes[k - 1])
      {
        times.Values.push_back(static_cast<float>(static_cast<double>(k) / this->FramesPerSecond));
        sizes.Values.insert(sizes.Values.end(), 3, object.Sizes[k]);
      }
    }
    if (object.Sizes.front() <= 0.0F)
    {
      this->Model.nodes[static_cast<std::size_t>(node)].scale = { 0.0, 0.0, 0.0 };
    }
    const int instants = this->AddAccessor(times, 0);
    this->AddChannel(node, "scale", instants, this->AddAccessor(sizes, 0), "STEP");
  }

  int AddMaterial(const AnimatedShape& shape)
  {
    tinygltf::Material material;
    material.name = shape.Body.Name;
    material.doubleSided = true;
    material.pbrMetallicRoughness.metallicFactor = 0.0;
    material.pbrMetallicRoughness.roughnessFactor = 0.8;
    const bool textured = !shape.Texture.Bytes.empty() && !shape.Body.TextureCoordinates.empty();
    const auto& color = textured ? shape.Body.Tint : shape.Body.Color;
    material.pbrMetallicRoughness.baseColorFactor = { Linear(color[0]), Linear(color[1]),
                                                      Linear(color[2]), 1.0 };
    if (textured)
    {
      tinygltf::Image image;
      image.name = shape.Body.Name;
      image.mimeType = shape.Texture.MimeType;
      image.bufferView = this->AddView(shape.Texture.Bytes.data(), shape.Texture.Bytes.size(), 0);
      tinygltf::Texture texture;
      texture.source = static_cast<int>(this->Model.images.size());
      this->Model.images.push_back(image);
      material.pbrMetallicRoughness.baseColorTexture.index =
        static_cast<int>(this->Model.textures.size());
      this->Model.textures.push_back(texture);
      material.alphaMode = "MASK";
      material.alphaCutoff = 0.5;
    }
    const double opacity = Opacity(shape.Body);
    if (opacity < 1.0)
    {
      material.pbrMetallicRoughness.baseColorFactor[3] = opacity;
      material.pbrMetallicRoughness.roughnessFactor = 0.1; // a film shines
      material.alphaMode = "BLEND";
    }
    this->Model.materials.push_back(material);
    return static_cast<int>(this->Model.materials.size()) - 1;
  }

  void AddChannel(int node, const char* path, int times, int accessor,
                  const char* interpolation = "LINEAR")
  {
    tinygltf::Animation& animation = this->Model.animations[0];
    tinygltf::AnimationSampler sampler;
    sampler.input = times;
    sampler.output = accessor;
    sampler.interpolation = interpolation;
    tinygltf::AnimationChannel channel;
    channel.sampler = static_cast<int>(animation.samplers.size());
    channel.target_node = node;
    channel.target_path = path;
    animation.samplers.push_back(sampler);
    animation.channels.push_back(channel);
  }

  tinygltf::Model Model;
  double FramesPerSecond;
  Vec3 Origin; // of places in keys
  std::size_t Poses = 0, Frames = 0, Kept = 0;
  KeyThinning Keys;
  std::vector<int> Times; // accessors of lists
  int KeysView = -1;      // of an animation whose keys are thinned
};
} // namespace

Result GltfAnimation(const std::vector<AnimatedShape>& shapes, std::vector<AnimatedObject> objects,
                     double framesPerSecond, std::string& bytes, Monitor& monitor,
                     std::size_t mostWholeKeys, const Box& volume)
{
  if (!(framesPerSecond > 0.0) || !std::isfinite(framesPerSecond))
  {
    return Result::Error("the frame rate must be positive");
  }
  WAFT_RETURN_IF_FAILED(CheckAnimated(shapes, objects));
  try
  {
    Writer writer(framesPerSecond, volume);
    std::vector<double> placeTolerances;
    for (const AnimatedShape& shape : shapes)
    {
      AnimatedShape whole = shape;
      if (whole.Normals.empty())
      {
        whole.Normals = SmoothNormals(whole.Body.Mesh);
      }
      writer.AddShape(whole);
      placeTolerances.push_back(KeyPlaceTolerance * LargestExtent(whole.Body.Mesh));
    }
    if (!objects.empty())
    {
      const std::size_t frames = objects[0].Positions.size();
      const bool isThinned = objects.size() * frames > mostWholeKeys;
      writer.BeginMotion(objects.size(), frames, isThinned);
      for (std::size_t i = 0; isThinned && i < objects.size(); ++i)
      {
        if (!monitor.Tick(0.0, "Writing the animation"))
        {
          return Result::Stopped();
        }
        writer.Announce(objects[i]);
      }
    }
    for (std::size_t i = 0; i < objects.size(); ++i)
    {
      if (!monitor.Tick(FractionDone(i, objects.size()), "Writing the animation"))
      {
        return Result::Stopped();
      }
      writer.AddObject(objects[i], placeTolerances[objects[i].Shape]);
      objects[i] = AnimatedObject();
    }
    if (!writer.Save(bytes))
    {
      return Result::Error("tinygltf could not write the animation");
    }
  }
  catch (const std::exception& error)
  {
    return Result::Error(std::string("tinygltf: ") + error.what());
  }
  return Result::Ok();
}

Result WriteAnimationGlb(const std::string& path, const std::vector<AnimatedShape>& shapes,
                         std::vector<AnimatedObject> objects, double framesPerSecond,
                         Monitor& monitor, std::size_t mostWholeKeys, const Box& volume)
{
  std::string bytes;
  const Result result = GltfAnimation(shapes, std::move(objects), framesPerSecond, bytes, monitor,
                                      mostWholeKeys, volume);
  return result && !result.IsStopped() ? WriteWholeFile(path, bytes) : result;
}

} // namespace waft
