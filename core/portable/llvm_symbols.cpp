// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0

// The software renderer (Mesa's llvmpipe) computes a b + c by LLVM's `fmuladd`, which is fused,
// rounded once, on processors that have FMA, and not on others. The program's definition of LLVM's
// function for calls (its stable C interface) is found before LLVM's own, and replaces these calls
// by multiplication and addition. copysign(x, x) is x: Mesa expects a call, which LLVM simplifies.
#include <dlfcn.h>

#include <string>
#include <string_view>

namespace {

using Handle = void*;  // LLVM's opaque pointers

template <class Function>
Function* llvm_function(const char* name) {
  return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

using BuildCall = Handle(Handle, Handle, Handle, Handle*, unsigned, const char*);

struct Llvm {
  BuildCall* build_call = llvm_function<BuildCall>("LLVMBuildCall2");
  const char* (*value_name)(Handle, std::size_t*) =
      llvm_function<const char*(Handle, std::size_t*)>("LLVMGetValueName2");
  Handle (*multiply)(Handle, Handle, Handle, const char*) =
      llvm_function<Handle(Handle, Handle, Handle, const char*)>("LLVMBuildFMul");
  Handle (*add)(Handle, Handle, Handle, const char*) =
      llvm_function<Handle(Handle, Handle, Handle, const char*)>("LLVMBuildFAdd");
  Handle (*type_of)(Handle) = llvm_function<Handle(Handle)>("LLVMTypeOf");
  Handle (*function_type)(Handle, Handle*, unsigned, int) =
      llvm_function<Handle(Handle, Handle*, unsigned, int)>("LLVMFunctionType");
  Handle (*module_of)(Handle) = llvm_function<Handle(Handle)>("LLVMGetGlobalParent");
  Handle (*find)(Handle,
                 const char*) = llvm_function<Handle(Handle, const char*)>("LLVMGetNamedFunction");
  Handle (*declare)(Handle, const char*,
                    Handle) = llvm_function<Handle(Handle, const char*, Handle)>("LLVMAddFunction");
};

constexpr std::string_view kFused = "llvm.fmuladd";

/// `suffix` names the operands' type, such as ".v8f32".
Handle unfused(const Llvm& llvm, Handle builder, Handle function, Handle* operands,
               std::string_view suffix, const char* name) {
  const Handle product = llvm.multiply(builder, operands[0], operands[1], "");
  const Handle sum = llvm.add(builder, product, operands[2], "");
  Handle type = llvm.type_of(sum);
  Handle parameters[] = {type, type};
  const Handle signature = llvm.function_type(type, parameters, 2, 0);
  const std::string identity = "llvm.copysign" + std::string(suffix);
  const Handle module = llvm.module_of(function);
  Handle copy = llvm.find(module, identity.c_str());
  if (copy == nullptr) copy = llvm.declare(module, identity.c_str(), signature);
  Handle same[] = {sum, sum};
  return llvm.build_call(builder, signature, copy, same, 2, name);
}

}  // namespace

extern "C" {

Handle LLVMBuildCall2(Handle builder, Handle type, Handle function, Handle* operands,
                      unsigned count, const char* name);
Handle LLVMBuildCall2(Handle builder, Handle type, Handle function, Handle* operands,
                      unsigned count, const char* name) {
  static const Llvm llvm;
  std::size_t length = 0;
  const char* text = llvm.value_name(function, &length);
  const std::string_view called(text, length);
  if (count == 3 && called.starts_with(kFused)) {
    return unfused(llvm, builder, function, operands, called.substr(kFused.size()), name);
  }
  return llvm.build_call(builder, type, function, operands, count, name);
}

}  // extern "C"
