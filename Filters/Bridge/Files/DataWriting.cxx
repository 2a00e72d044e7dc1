// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Files/DataWriting.h"

#include <vtkDataObject.h>
#include <vtkDataSet.h>
#include <vtkDoubleArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkTable.h>
#include <vtkXMLImageDataWriter.h>
#include <vtkXMLPolyDataWriter.h>
#include <vtkXMLTableWriter.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <locale>
#include <ostream>
#include <streambuf>
#include <unistd.h>

namespace waft
{
namespace
{

// Writes to a file, and takes for written what that has no room for: VTK's writers end the process
// where a stream fails.
class FileBuffer : public std::streambuf
{
public:
  explicit FileBuffer(const std::string& path) :
    Descriptor(open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666)),
    Reason(this->Descriptor < 0 ? errno : 0)
  {
    this->setp(this->Bytes.data(), this->Bytes.data() + this->Bytes.size());
  }
  ~FileBuffer() override { this->Close(); }
  FileBuffer(const FileBuffer&) = delete;
  void operator=(const FileBuffer&) = delete;

  /// The first error, or 0.
  int Close()
  {
    this->Flush();
    if (this->Descriptor >= 0 && close(this->Descriptor) != 0 && this->Reason == 0)
    {
      this->Reason = errno;
    }
    this->Descriptor = -1;
    return this->Reason;
  }

protected:
  int_type overflow(int_type character) override
  {
    this->Flush();
    return traits_type::eq_int_type(character, traits_type::eof())
             ? traits_type::not_eof(character)
             : this->sputc(traits_type::to_char_type(character));
  }
  int sync() override
  {
    this->Flush();
    return 0;
  }
  pos_type seekoff(off_type offset, std::ios_base::seekdir from, std::ios_base::openmode) override
  {
    if (from == std::ios_base::end)
    {
      return pos_type(off_type(-1)); // which no writer asks for
    }
    const off_type here = this->At + (this->pptr() - this->pbase());
    return this->MoveTo(from == std::ios_base::cur ? here + offset : offset);
  }
  pos_type seekpos(pos_type position, std::ios_base::openmode) override
  {
    return this->MoveTo(position);
  }

private:
  pos_type MoveTo(off_type position)
  {
    if (position != this->At + (this->pptr() - this->pbase()))
    {
      this->Flush();
      this->At = position;
    }
    return position;
  }
  void Flush()
  {
    const char* from = this->pbase();
    while (from < this->pptr() && this->Reason == 0)
    {
      const auto size = static_cast<std::size_t>(this->pptr() - from);
      const ssize_t written = pwrite(this->Descriptor, from, size, this->At);
      if (written < 0 && errno != EINTR)
      {
        this->Reason = errno;
      }
      from += std::max<ssize_t>(written, 0);
      this->At += std::max<ssize_t>(written, 0);
    }
    this->At += this->pptr() - from;
    this->setp(this->Bytes.data(), this->Bytes.data() + this->Bytes.size());
  }

  std::array<char, 1 << 16> Bytes;
  int Descriptor;
  int Reason;
  off_t At = 0; // of the first of the bytes that wait
};

// A writer of VTK's to a stream of ours.
template <class Writer>
class StreamWriter : public Writer
{
public:
  static StreamWriter* New() { VTK_STANDARD_NEW_BODY(StreamWriter); }

  void WriteTo(std::ostream& stream) { this->Stream = &stream; } // in place of a file
  const DataFileForm* Form = nullptr;

protected:
  // One array is there twice at a time.
  void WriteArrayInline(vtkAbstractArray* array, vtkIndent indent, const char* name,
                        int numberOfTuples) override
  {
    vtkNew<vtkDoubleArray> rounded;
    if (this->IsToBeRounded(array))
    {
      rounded->DeepCopy(array);
      double* values = rounded->GetPointer(0);
      std::transform(values, values + rounded->GetNumberOfValues(), values,
                     [](double value) { return static_cast<double>(static_cast<float>(value)); });
      array = rounded;
    }
    this->Writer::WriteArrayInline(array, indent, name, numberOfTuples);
  }

private:
  bool IsToBeRounded(vtkAbstractArray* array)
  {
    auto* data = vtkDataSet::SafeDownCast(this->GetInput());
    return this->Form->IsRounded && data != nullptr && vtkDoubleArray::SafeDownCast(array) &&
           array->GetName() != nullptr && this->Form->Exact.count(array->GetName()) == 0 &&
           data->GetPointData()->GetAbstractArray(array->GetName()) == array;
  }
};

template <class Writer>
bool WriteBy(vtkDataObject* data, const DataFileForm& form, std::ostream& stream)
{
  vtkNew<StreamWriter<Writer>> writer;
  writer->WriteTo(stream);
  writer->Form = &form;
  writer->SetInputDataObject(data);
  writer->SetDataModeToBinary();
  if (form.PacksWell)
  {
    writer->SetCompressorTypeToLZMA();
    writer->SetBlockSize(1 << 22);
  }
  writer->SetCompressionLevel(1); // a quarter of the usual level's time, files 2 % larger
  return writer->Write() != 0;
}

} // namespace

Result WriteDataFile(const std::string& path, vtkDataObject* data, const DataFileForm& form)
{
  FileBuffer buffer(path);
  std::ostream stream(&buffer);
  stream.imbue(std::locale::classic());
  const bool isWritten =
    vtkPolyData::SafeDownCast(data) != nullptr ? WriteBy<vtkXMLPolyDataWriter>(data, form, stream)
    : vtkImageData::SafeDownCast(data) != nullptr
      ? WriteBy<vtkXMLImageDataWriter>(data, form, stream)
      : vtkTable::SafeDownCast(data) != nullptr && WriteBy<vtkXMLTableWriter>(data, form, stream);
  if (const int reason = buffer.Close(); reason != 0)
  {
    return Result::Error(std::strerror(reason));
  }
  return isWritten ? Result::Ok() : Result::Error("VTK's writer failed");
}

} // namespace waft
